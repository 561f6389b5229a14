// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <set>
#include <string>
#include <string_view>

namespace tetralux::mesh {

/// Names of kept tensors (shading/kept_anisotropy.h) begin so.
inline constexpr std::string_view anisotropyPrefix = "anisotropy(";

/// Whether programs use this name for numbers of points, cells or blocks, or for kept tensors, which nobody wants to
/// see unasked.
inline bool isBookkeepingName(const std::string& name) {
    static const std::set<std::string> known{
        "GlobalNodeId",        "GlobalElementId",    "PedigreeNodeId",    "PedigreeElementId", "ObjectId",
        "vtkOriginalPointIds", "vtkOriginalCellIds", "GLOBAL_IDS_POINTS", "GLOBAL_IDS_CELLS",  "vtkCompositeIndex"};
    return known.contains(name) || name.starts_with(anisotropyPrefix);
}

}  // namespace tetralux::mesh
