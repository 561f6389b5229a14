// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <variant>
#include <vector>

#include <mesh/io/read_mesh.h>

#include "geometry.h"

namespace tetralux::mesher {

/// A surface or points, or cells that are already (or have been made) tetrahedra.
using Input = std::variant<PolygonSoup, mesh::ReadResult>;

/// Reads `source` by the ending of its name. `leftOut` gets the names of fields that cannot be taken along.
/// \throws std::runtime_error with one line that begins with `source`.
Input readInput(const std::string& source, std::vector<std::string>& leftOut);

}  // namespace tetralux::mesher
