// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>

namespace tetralux::mesh {

/// What an element type of Gmsh is in VTK's terms.
struct GmshElement {
    int points = 0;              ///< in the file; 0 for a type that we do not know
    std::uint8_t type = 0;       ///< VTK cell type
    std::span<const int> order;  ///< VTK's points as places in Gmsh's list
};

/// Complete solids of any order, and incomplete (serendipity) ones of order two. What it returns stays valid as long as
/// the thread.
GmshElement gmshElement(int gmshType);

}  // namespace tetralux::mesh
