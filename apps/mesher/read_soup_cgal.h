// SPDX-License-Identifier: Apache-2.0
/// \file
/// The one door to CGAL's readers of polygon files.
#pragma once

#include <string>

#include "geometry.h"

namespace tetralux::mesher {

/// Reads `.stl` (ASCII or binary; points that coincide exactly become one), `.off`, `.obj` or `.ply` (ASCII or binary,
/// with its numeric vertex properties as fields). \throws std::runtime_error naming the file when it is broken or its
/// ending is another.
PolygonSoup readSoupByCgal(const std::string& path);

}  // namespace tetralux::mesher
