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

/// Gmsh's solids of an order above two become linear ones over their corners.
GmshElement gmshElement(int gmshType);

}  // namespace tetralux::mesh
