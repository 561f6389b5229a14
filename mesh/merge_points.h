// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include <mesh/cell_soup.h>
#include <mesh/mesh_report.h>

namespace tetralux::mesh {

/// Makes cells that name different points at one place name the same one (the lowest number), so that pieces and blocks
/// that were written separately become neighbours.
///
/// Without a tolerance only points at exactly the same position with the same values of all point fields are merged,
/// which changes no picture; those at one position with different values (a jump of the field) stay apart and are
/// counted as coincident. With a tolerance (mesh units, ≥ 0) every point within it of an earlier one that stays
/// is merged into that, whatever its values, and counted. Points themselves are not removed.
void mergeCoincidentPoints(CellSoup& soup, std::optional<double> tolerance, MeshReport& report);

}  // namespace tetralux::mesh
