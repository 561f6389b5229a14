// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <mesh/soup/cell_soup.h>
#include <mesh/soup/soup_checks.h>

namespace tetralux::mesh {

/// Turns every cell field into a point field: at each point the mean over the kept cells that name it, each counted
/// once whatever its size. Non-finite cell values take no part; a point without any value gets NaN. A name that a point
/// field already has gets " (smoothed)" behind it.
void smoothCellFields(CellSoup& soup, const std::vector<CellVerdict>& verdicts);

}  // namespace tetralux::mesh
