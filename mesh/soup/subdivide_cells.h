// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <mesh/soup/cell_soup.h>
#include <mesh/soup/soup_checks.h>

namespace tetralux::mesh {

/// Replaces the kept curved cells of `soup` (quadratic, Lagrange, Bézier) by linear ones on a lattice with `segments`
/// pieces along each edge, or as many as the cell's order when `segments` is 0. Lattice points that are no points of
/// the cell are added with all point fields by the cell's shape functions; cells that share a face share its lattice
/// points. Hidden and faulty cells are left out, curved cells of no known order get the verdict Unsupported. Cell
/// fields stay one per source cell. \returns the source cell of each cell of `soup`; nothing, with nothing changed,
/// when none was curved.
std::optional<std::vector<std::uint32_t>> subdivideCurvedCells(CellSoup& soup, std::vector<CellVerdict>& verdicts,
                                                               int segments);

}  // namespace tetralux::mesh
