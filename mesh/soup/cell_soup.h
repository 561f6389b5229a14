// SPDX-License-Identifier: Apache-2.0
/// \file
/// What a reader returns: cells of any type, unchecked. Only `validation.h` makes a mesh of it.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include <mesh/tet/field.h>

namespace tetralux::mesh {

/// What the cells with `number` in the cell field `field` are called in the source: a block, zone, part or group.
struct BlockName {
    std::string field;
    double number = 0.0;
    std::string name;
    bool operator==(const BlockName&) const = default;
};

/// Mixed cells in the numbering of VTK's cell types (`cell_types.h` names them). Nothing is promised: indices may
/// be out of range, positions not finite, arrays of the wrong length.
struct CellSoup {
    std::vector<glm::dvec3> points;      ///< mesh units
    std::vector<std::uint8_t> types;     ///< VTK cell type of each cell
    std::vector<std::uint64_t> offsets;  ///< cell i has connectivity[offsets[i] … offsets[i + 1]); one more than cells
    std::vector<std::uint32_t> connectivity;  ///< point numbers; `invalidPoint` for one that 32 bits cannot hold

    /// A reader that finds nothing but tetrahedra may put their points here instead of filling types, offsets and
    /// connectivity, which takes half the memory.
    std::vector<std::array<std::uint32_t, 4>> tetrahedra;

    /// Polyhedra only, else empty: cell i has faceStream[faceOffsets[i] … faceOffsets[i + 1]), which holds for each of
    /// its faces the number of points and then these.
    std::vector<std::uint64_t> faceOffsets;
    std::vector<std::uint32_t> faceStream;

    std::vector<Field> fields;
    std::vector<std::uint8_t> hidden;  ///< 1 for a ghost or blanked cell; empty when there is none
    std::vector<double> times;         ///< of all steps, if the source is a series; the cells are those of one
    std::vector<BlockName> blockNames;
    std::vector<std::string> notes;  ///< what the reader chose or left out that its user should know, a line each

    static constexpr std::uint32_t invalidPoint = 0xffffffffu;
    std::size_t cellCount() const { return tetrahedra.empty() ? types.size() : tetrahedra.size(); }
};

/// Adds a cell to `soup` (offsets get their leading 0 with the first).
template <class Points>
void appendCell(CellSoup& soup, std::uint8_t type, const Points& points) {
    if (soup.offsets.empty()) {
        soup.offsets.push_back(0);
    }
    soup.types.push_back(type);
    soup.connectivity.insert(soup.connectivity.end(), std::begin(points), std::end(points));
    soup.offsets.push_back(soup.connectivity.size());
}

}  // namespace tetralux::mesh
