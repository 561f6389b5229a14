// SPDX-License-Identifier: Apache-2.0
/// \file
/// From what a reader returned to a mesh that can be relied on.
#pragma once

#include <mesh/soup/cell_soup.h>
#include <mesh/soup/read_options.h>

namespace tetralux::mesh {

/// Checks `soup`, takes its cells apart and keeps what is sound. Cells that are hidden, flat, not solid, of an unknown
/// type, duplicates, or that name a point out of range or at a non-finite position are left out; inverted ones are
/// turned round; points that no tetrahedron uses are dropped. All is counted in the report, by cell and point numbers
/// of the source. Cell values go to every tetrahedron of the cell. \throws std::runtime_error without the name of the
/// source, if its arrays do not fit together or no tetrahedron is left.
ReadResult tetMeshFromSoup(CellSoup soup, const ReadOptions& options = {});

}  // namespace tetralux::mesh
