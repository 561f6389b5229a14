// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <mesh/soup/cell_soup.h>

namespace tetralux::mesh {

/// Appends `other` to `soup`. Fields are the same by name; one that only one of them has is NaN in the other.
void appendSoup(CellSoup& soup, CellSoup&& other);

/// Gives tetrahedra that stand by themselves types, offsets and connectivity, as other cells have.
void preferGeneralCells(CellSoup& soup);

}  // namespace tetralux::mesh
