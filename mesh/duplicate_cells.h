// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include <mesh/tet_mesh.h>

namespace tetralux::mesh {

/// 1 for every cell that has the same four points as one before it, else 0; empty when there is none. In parallel.
std::vector<std::uint8_t> findDuplicateCells(const std::vector<Tetrahedron>& cells, std::size_t pointCount);

}  // namespace tetralux::mesh
