// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

namespace tetralux::mesh {

/// Reverses faces of a polyhedron until neighbours agree on which way is out, for files whose writers did not care.
/// Faces are lists of point numbers. \returns false if the surface is open (an edge with one face) or one-sided.
bool makeFacesAgree(std::vector<std::vector<std::uint32_t>>& faces);

}  // namespace tetralux::mesh
