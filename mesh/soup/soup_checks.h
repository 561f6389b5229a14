// SPDX-License-Identifier: Apache-2.0
/// \file
/// What can be said of each cell of a CellSoup on its own, before any is taken apart.
#pragma once

#include <cstdint>
#include <vector>

#include <mesh/soup/cell_soup.h>
#include <mesh/tet/mesh_report.h>

namespace tetralux::mesh {

enum class CellVerdict : std::uint8_t {
    Good,
    Inverted,      ///< kept, turned round
    Folded,        ///< kept but for the parts of it that lie inside out
    LowDimension,  ///< a point, line or surface cell
    Hidden,        ///< ghost or blanked
    IndexOutOfRange,
    NonFinitePosition,
    Unsupported,  ///< unknown type, or a number of points that its type does not have
    Flat,
    Duplicate,  ///< of the same points as one before it
};

inline bool isKept(CellVerdict verdict) {
    return verdict <= CellVerdict::Folded;
}

/// Makes sure that the arrays of `soup` fit together, so that nothing later reads outside them.
/// \throws std::runtime_error saying which does not.
void checkStructure(const CellSoup& soup);

/// Gives each cell that has the number of points of another type of its shape that type: some writers say hexahedron
/// (12) of one with 20 points. Needs `checkStructure`.
void correctTypes(CellSoup& soup);

/// A verdict for each cell from its type and point numbers, and for all but tetrahedra from its positions (not yet
/// Inverted, Folded or Flat), in parallel. Needs `checkStructure`.
std::vector<CellVerdict> classifyCells(const CellSoup& soup);

/// Counts cells, their types and their verdicts into `report`.
void reportCells(const std::vector<std::uint8_t>& types, const std::vector<CellVerdict>& verdicts, MeshReport& report);
/// The same for tetrahedra; no verdicts if all are Good.
void reportTetrahedra(std::size_t count, const std::vector<CellVerdict>& verdicts, MeshReport& report);

/// 1 for each point that a cell names.
std::vector<std::uint8_t> namedPoints(const CellSoup& soup);

/// Counts points with a mark of 0.
void reportUnusedPoints(const std::vector<std::uint8_t>& used, MeshReport& report);

}  // namespace tetralux::mesh
