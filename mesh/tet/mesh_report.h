// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace tetralux::mesh {

/// Everything that can be wrong with a mesh, by name. `defectName` gives the text that reports show.
enum class Defect {
    NonFinitePosition,
    NonFiniteScalar,
    IndexOutOfRange,
    FlatCell,
    InvertedCell,
    DuplicateCell,
    NonManifoldFace,
    NonConformingInterface,
    UnusedPoint,
    CoincidentPoint,
    HiddenCell,
    UnsupportedCell,
    FoldedCell,       ///< part of it lies inside out
    OverlappingCell,  ///< it and another are in one place
};

std::string defectName(Defect defect);

/// What checking found: how often each defect, and the first few places (cell, face or point numbers of the
/// source) to look at.
struct DefectCount {
    std::uint64_t count = 0;
    std::vector<std::uint64_t> firstOffenders;  ///< at most 5
};

/// What became of a source mesh on its way to tetrahedra.
struct MeshReport {
    std::uint64_t cellsRead = 0;                     ///< cells of the source, of any type
    std::map<std::string, std::uint64_t> cellTypes;  ///< source cells by type name
    std::map<Defect, DefectCount> defects;
    std::uint64_t pointsMerged = 0;                ///< points that an equal one stands for
    std::uint64_t facesFitted = 0;                 ///< quadrilaterals cut as two triangles on their other side are
    std::vector<std::string> notes;                ///< what the reader chose or left out, a line each
    std::map<std::string, std::uint64_t> skipped;  ///< tetrahedra (or source cells) left out, by reason

    void add(Defect defect, std::uint64_t where);
};

}  // namespace tetralux::mesh
