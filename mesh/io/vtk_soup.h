// SPDX-License-Identifier: Apache-2.0
/// \file
/// What the readers built on VTK share. VTK's own headers stay in .cpp files.
#pragma once

#include <optional>
#include <string>

#include <mesh/soup/cell_soup.h>

class vtkAlgorithm;
class vtkDataObject;
class vtkOutputWindow;

namespace tetralux::mesh {

/// Cells, points and numeric arrays of a data set; those of all its leaves, one behind the other, if it is composite.
/// Structured grids and images become voxels and hexahedra. Ghost and blanked cells are marked hidden.
/// \throws std::runtime_error if the object is of a kind without cells.
CellSoup soupFromVtk(vtkDataObject* data);

/// Updates `reader`, at the time step nearest to `time` if it has several, and converts its first output. VTK's
/// messages are collected, not printed, from the first call on, so call it within `readThirdParty` only. \throws
/// std::runtime_error with the reader's first error message and a remedy, without the name of the file.
CellSoup soupFromReader(vtkAlgorithm& reader, std::optional<double> time);

/// While one lives, VTK prints nothing; then its messages go where they went before.
class SilentVtk {
public:
    SilentVtk();
    SilentVtk(const SilentVtk&) = delete;
    SilentVtk& operator=(const SilentVtk&) = delete;
    ~SilentVtk();

private:
    vtkOutputWindow* before_;
    int logged_;  ///< verbosity of the log
};

/// From now on VTK prints nothing and `throwOnVtkError` knows its messages.
void captureVtkMessages();

/// \throws std::runtime_error if VTK reported an error since `captureVtkMessages`.
void throwOnVtkError();

}  // namespace tetralux::mesh
