// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <mesh/soup/cell_soup.h>

namespace tetralux::mesh {

/// Takes the fields of `soup` in which VTK marks ghost, blanked and refined cells and points, and hides the cells.
void hideGhosts(CellSoup& soup);

}  // namespace tetralux::mesh
