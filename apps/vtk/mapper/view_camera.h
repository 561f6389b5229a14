// SPDX-License-Identifier: Apache-2.0
/// \file
/// What a vtkRenderer sees: Tetralux's camera, and how far opaque geometry is.
#pragma once

#include <array>
#include <vector>

#include <tetralux/tetralux.h>

class vtkRenderer;

namespace tetralux::vtk {

/// The part of the window that a renderer draws now.
struct WindowPart {
    int width = 0, height = 0;  ///< pixels
    int left = 0, bottom = 0;   ///< of its lower left pixel in the window
};

struct WindowView {
    WindowPart part;
    Camera camera;
    std::array<double, 16> worldFromClip{};  ///< rows of the matrix; clip coordinates from −1 to 1, depth too
};

/// The renderer's camera as its matrices have it, stereo, shear and tiles included. \throws Error for one that mirrors.
WindowView viewOf(vtkRenderer& renderer);

/// Distances along the rays, top row first, of what the depths, bottom row first, say; infinite where they are 1.
std::vector<float> distancesOf(const WindowView& view, const std::vector<float>& depths);

}  // namespace tetralux::vtk
