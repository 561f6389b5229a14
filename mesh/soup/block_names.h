// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <mesh/soup/cell_soup.h>

namespace tetralux::mesh {

/// The cell field that tells which part of its source a cell comes from, where a source has several.
inline constexpr const char* blockFieldName = "block";

/// Makes all cells of `part` the block of that number and name, unless it has a field of blocks already.
void nameBlock(CellSoup& part, double number, const std::string& name);

}  // namespace tetralux::mesh
