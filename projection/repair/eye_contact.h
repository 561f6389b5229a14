// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include <mesh/tet/tet_mesh.h>

namespace tetralux::projection {

/// Cells upon whose boundary the eye stands, as nearly as float tells. A ray that goes away from such a cell meets
/// nothing of it, but rounding may make a tiny segment of that, and modes in which the smallest segment counts (first
/// hit, extreme or mean scalar, depth) show it.
struct EyeContact {
    std::vector<mesh::CellIndex> cells;
    bool onBoundary = false;  ///< of the mesh: some rays meet nothing
};

EyeContact eyeContact(const mesh::ScalarMesh& mesh, const glm::dvec3& eye);

}  // namespace tetralux::projection
