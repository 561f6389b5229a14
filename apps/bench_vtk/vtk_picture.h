// SPDX-License-Identifier: Apache-2.0
/// \file
/// One of VTK's volume mappers for unstructured grids in a window that is never shown.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <apps/bench_vtk/request.h>

namespace tetralux::bench_vtk {

/// "9.1.0"
std::string vtkVersionText();

/// projected, ray-preint, ray-partial, ray-linear, zsweep.
std::vector<std::string> mapperNames();

class VtkPicture {
public:
    /// \throws std::runtime_error for an unknown mapper, listing those there are.
    VtkPicture(const MeshArrays& mesh, const Request& request);
    ~VtkPicture();

    /// Draws and waits until it is done. Milliseconds.
    double draw(const RequestedCamera& camera);

    /// The last picture: float RGBA, premultiplied over nothing, row 0 at the top. VTK keeps it in 8 bits per channel.
    std::vector<float> pixels() const;

    /// GL_RENDERER, or for mappers that compute on processors "… threads".
    std::string renderer() const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace tetralux::bench_vtk
