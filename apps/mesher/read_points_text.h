// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "geometry.h"

namespace tetralux::mesher {

/// Reads points with values from text: `.csv` (a header; columns x, y, z in any case and place, or else the first
/// three; separated by comma, semicolon or tab) or `.xyz`, `.txt` (numbers between blanks, x y z first; a header,
/// comments after # or //, and a first line with the number of points are all allowed). Every further column is a
/// field. NaN is read as such. \throws std::runtime_error naming file and line when a line is not like the others.
PolygonSoup readPointsText(const std::string& path);

}  // namespace tetralux::mesher
