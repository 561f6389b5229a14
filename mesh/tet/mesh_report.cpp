// SPDX-License-Identifier: Apache-2.0
#include <mesh/tet/mesh_report.h>

namespace tetralux::mesh {

std::string defectName(Defect defect) {
    switch (defect) {
        case Defect::NonFinitePosition:
            return "non-finite position";
        case Defect::NonFiniteScalar:
            return "non-finite scalar";
        case Defect::IndexOutOfRange:
            return "index out of range";
        case Defect::FlatCell:
            return "flat cell";
        case Defect::InvertedCell:
            return "inverted cell";
        case Defect::DuplicateCell:
            return "duplicate cell";
        case Defect::NonManifoldFace:
            return "non-manifold face";
        case Defect::NonConformingInterface:
            return "non-conforming interface";
        case Defect::UnusedPoint:
            return "unused point";
        case Defect::CoincidentPoint:
            return "coincident point";
        case Defect::HiddenCell:
            return "hidden cell";
        case Defect::UnsupportedCell:
            return "unsupported cell";
        case Defect::FoldedCell:
            return "folded cell";
        case Defect::OverlappingCell:
            return "overlapping cell";
    }
    return "unnamed defect";
}

void MeshReport::add(Defect defect, std::uint64_t where) {
    constexpr std::size_t offendersKept = 5;
    DefectCount& found = defects[defect];
    ++found.count;
    if (found.firstOffenders.size() < offendersKept) {
        found.firstOffenders.push_back(where);
    }
}

}  // namespace tetralux::mesh
