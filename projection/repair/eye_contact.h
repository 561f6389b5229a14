// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include <mesh/tet/tet_mesh.h>

namespace tetralux::projection {

/// Cells upon whose boundary the eye stands as nearly as float tells. Such a cell begins or ends where the ray does: for a
/// ray that goes away from it that is nothing, which rounding takes for a little, and pictures that take anything for
/// something (first hit, extreme or mean scalar, depth) show it.
struct EyeContact {
    std::vector<mesh::CellIndex> cells;
    bool onBoundary = false;  ///< of the mesh: some rays meet nothing
};

EyeContact eyeContact(const mesh::ScalarMesh& mesh, const glm::dvec3& eye);

}  // namespace tetralux::projection
