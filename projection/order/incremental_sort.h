// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include <projection/order/visibility_relations.h>

namespace tetralux::projection {

/// Makes `order` (cells from near to far; `places` is its inverse) keep all relations by moving as few cells as need
/// be: for each pair of `violations`, the cells between the two that lie behind the farther or in front of the nearer
/// change places among themselves (Pearce & Kelly, "A Dynamic Topological Sort Algorithm for Directed Acyclic Graphs",
/// 2006). False when that would take more than sorting anew, or the relations have a cycle; the order is of no use
/// then.
bool repairOrder(const VisibilityRelations& relations, const std::vector<CellPair>& violations,
                 std::vector<mesh::CellIndex>& order, std::vector<std::uint32_t>& places);

}  // namespace tetralux::projection
