// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <mesh/soup/cell_soup.h>
#include <mesh/tet/mesh_report.h>

namespace tetralux::mesh {

/// For each point the one that stands for it: the lowest number among those at one place. Empty if every point stands
/// for itself.
using Representatives = std::vector<std::uint32_t>;

/// Finds different points at one place, so that cells of pieces and blocks that were written separately can become
/// neighbours.
///
/// Without a tolerance only points at exactly the same position with the same values of all point fields are merged,
/// which changes no picture; those at one position with different values (a jump of the field) stay apart and are
/// counted as coincident. With a tolerance (mesh units, ≥ 0) every point within it of an earlier one that stays
/// is merged into that, whatever its values, and counted.
Representatives findCoincidentPoints(const CellSoup& soup, std::optional<double> tolerance, MeshReport& report);

/// Makes cells name the points that stand for theirs. Points themselves are not removed.
void mergePoints(CellSoup& soup, const Representatives& representatives);

}  // namespace tetralux::mesh
