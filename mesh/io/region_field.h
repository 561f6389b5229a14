// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include <mesh/soup/cell_soup.h>

namespace tetralux::mesh {

/// Adds the region, material or entity number of each cell as a cell field. It is shown unasked only if the solid cells
/// have more than one.
void addRegionField(CellSoup& soup, const std::string& name, std::vector<double>&& numbers);

}  // namespace tetralux::mesh
