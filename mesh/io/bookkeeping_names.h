// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <set>
#include <string>

namespace tetralux::mesh {

/// Whether programs use this name for numbers of points, cells or blocks, which nobody wants to see unasked.
inline bool isBookkeepingName(const std::string& name) {
    static const std::set<std::string> known{
        "GlobalNodeId",        "GlobalElementId",    "PedigreeNodeId",    "PedigreeElementId", "ObjectId",
        "vtkOriginalPointIds", "vtkOriginalCellIds", "GLOBAL_IDS_POINTS", "GLOBAL_IDS_CELLS",  "vtkCompositeIndex"};
    return known.contains(name);
}

}  // namespace tetralux::mesh
