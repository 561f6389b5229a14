// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <mesh/tet/tet_mesh.h>

namespace tetralux::mesh {

/// Writes `mesh` with all its fields as a VTK XML unstructured grid: doubles and 64-bit integers, appended raw, not
/// compressed. Written beside `path` and renamed when whole. \throws std::runtime_error naming `path` if it cannot be.
void writeVtu(const std::string& path, const TetMesh& mesh);

}  // namespace tetralux::mesh
