// SPDX-License-Identifier: Apache-2.0
#include <mesh/soup/soup_checks.h>

#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <stdexcept>

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <mesh/soup/cell_types.h>
#include <mesh/tet/orientation.h>
#include <mesh/tet/shared_mark.h>

namespace tetralux::mesh {
namespace {

using Range = tbb::blocked_range<std::size_t>;
constexpr std::size_t grain = 16384;

/// That offsets run from 0 to `size` and never back.
void checkOffsets(const std::vector<std::uint64_t>& offsets, std::size_t cells, std::size_t size, const char* what) {
    const bool ordered = offsets.size() == cells + 1 && offsets.front() == 0 && offsets.back() == size &&
                         std::is_sorted(offsets.begin(), offsets.end());
    if (!ordered) {
        throw std::runtime_error(fmt::format(
            "the {} of its cells do not fit together (offsets run back or past the end); write the file again", what));
    }
}

std::span<const std::uint32_t> cellPoints(const CellSoup& soup, std::size_t cell) {
    return {soup.connectivity.data() + soup.offsets[cell], soup.connectivity.data() + soup.offsets[cell + 1]};
}

std::span<const std::uint32_t> cellFaceStream(const CellSoup& soup, std::size_t cell) {
    return {soup.faceStream.data() + soup.faceOffsets[cell], soup.faceStream.data() + soup.faceOffsets[cell + 1]};
}

/// Whether a polyhedron's stream is whole: at least 4 faces of at least 3 points each, and nothing after them.
bool isWholeStream(std::span<const std::uint32_t> stream) {
    std::size_t faces = 0;
    for (std::size_t at = 0; at < stream.size(); ++faces) {
        const std::size_t points = stream[at];
        if (points < 3 || points > stream.size() - at - 1) {
            return false;
        }
        at += points + 1;
    }
    return faces >= 4;
}

CellVerdict checkPoints(const CellSoup& soup, std::span<const std::uint32_t> points) {
    CellVerdict verdict = CellVerdict::Good;
    for (const std::uint32_t p : points) {
        if (p >= soup.points.size()) {
            return CellVerdict::IndexOutOfRange;
        }
        const glm::dvec3& x = soup.points[p];
        if (!isFinitePosition(x)) {
            verdict = CellVerdict::NonFinitePosition;
        }
    }
    return verdict;
}

CellVerdict checkPolyhedron(const CellSoup& soup, std::size_t cell) {
    const auto stream = soup.faceOffsets.empty() ? std::span<const std::uint32_t>{} : cellFaceStream(soup, cell);
    if (!isWholeStream(stream)) {
        return CellVerdict::Unsupported;
    }
    CellVerdict verdict = CellVerdict::Good;
    for (std::size_t at = 0; at < stream.size(); at += stream[at] + 1) {
        const CellVerdict found = checkPoints(soup, stream.subspan(at + 1, stream[at]));
        if (found == CellVerdict::IndexOutOfRange) {
            return found;
        }
        verdict = found == CellVerdict::Good ? verdict : found;
    }
    return verdict;
}

/// Positions are left to decomposition, which looks at them anyway.
CellVerdict checkTetrahedron(const CellSoup& soup, std::uint64_t at) {
    const std::uint32_t* const p = soup.connectivity.data() + at;
    const std::size_t last = std::max({p[0], p[1], p[2], p[3]});
    return last < soup.points.size() ? CellVerdict::Good : CellVerdict::IndexOutOfRange;
}

CellVerdict classifyCell(const CellSoup& soup, std::size_t cell) {
    if (!soup.hidden.empty() && soup.hidden[cell] != 0) {
        return CellVerdict::Hidden;
    }
    const std::uint8_t type = soup.types[cell];
    if (type == cell_type::tetrahedron && soup.offsets[cell + 1] - soup.offsets[cell] == 4) {
        return checkTetrahedron(soup, soup.offsets[cell]);
    }
    const CellTypeInfo info = cellTypeInfo(type);
    if (info.dimension >= 0 && info.dimension < 3) {
        return CellVerdict::LowDimension;
    }
    if (type == cell_type::polyhedron) {
        return checkPolyhedron(soup, cell);
    }
    const auto points = cellPoints(soup, cell);
    const bool known = info.linear || info.shape != Shape::None;
    if (!known || points.size() < 4 ||
        (info.pointCount != 0 && points.size() != static_cast<std::size_t>(info.pointCount))) {
        return CellVerdict::Unsupported;
    }
    return checkPoints(soup, points);
}

/// The type of the same shape as `type` that has `points` points; `type` itself if there is none.
std::uint8_t typeOfShape(std::uint8_t type, std::size_t points) {
    using namespace cell_type;
    const CellTypeInfo info = cellTypeInfo(type);
    if (info.shape == Shape::None || info.pointCount == 0 || type == voxel ||
        static_cast<std::size_t>(info.pointCount) == points) {
        return type;
    }
    for (const std::uint8_t other :
         {tetrahedron, hexahedron, wedge, pyramid, quadraticTetrahedron, quadraticHexahedron, quadraticWedge,
          quadraticPyramid, triquadraticHexahedron, biquadraticQuadraticHexahedron, quadraticLinearWedge,
          biquadraticQuadraticWedge, triquadraticPyramid}) {
        const CellTypeInfo candidate = cellTypeInfo(other);
        if (candidate.shape == info.shape && static_cast<std::size_t>(candidate.pointCount) == points) {
            return other;
        }
    }
    return type;
}

void reportTypes(const std::vector<std::uint8_t>& types, MeshReport& report) {
    std::array<std::uint64_t, 256> counts{};
    for (const std::uint8_t type : types) {
        ++counts[type];
    }
    for (std::size_t type = 0; type < counts.size(); ++type) {
        if (counts[type] > 0) {
            report.cellTypes[cellTypeInfo(static_cast<std::uint8_t>(type)).name] += counts[type];
        }
    }
}

std::optional<Defect> defectOf(CellVerdict verdict) {
    switch (verdict) {
        case CellVerdict::Good:
        case CellVerdict::LowDimension:
            return std::nullopt;
        case CellVerdict::Inverted:
            return Defect::InvertedCell;
        case CellVerdict::Folded:
            return Defect::FoldedCell;
        case CellVerdict::Hidden:
            return Defect::HiddenCell;
        case CellVerdict::IndexOutOfRange:
            return Defect::IndexOutOfRange;
        case CellVerdict::NonFinitePosition:
            return Defect::NonFinitePosition;
        case CellVerdict::Unsupported:
            return Defect::UnsupportedCell;
        case CellVerdict::Flat:
            return Defect::FlatCell;
        case CellVerdict::Duplicate:
            return Defect::DuplicateCell;
    }
    return std::nullopt;
}

template <class TypeOf>
void reportVerdicts(const TypeOf& typeOf, const std::vector<CellVerdict>& verdicts, MeshReport& report) {
    for (std::size_t cell = 0; cell < verdicts.size(); ++cell) {
        if (verdicts[cell] == CellVerdict::Good) {
            continue;
        }
        const CellTypeInfo info = cellTypeInfo(typeOf(cell));
        if (verdicts[cell] == CellVerdict::LowDimension) {
            ++report.skipped[fmt::format("not solid ({})", info.name)];
            continue;
        }
        const Defect defect = *defectOf(verdicts[cell]);
        report.add(defect, cell);
        if (!isKept(verdicts[cell])) {
            const bool unsupported = defect == Defect::UnsupportedCell;
            ++report.skipped[unsupported ? fmt::format("{} ({})", defectName(defect), info.name) : defectName(defect)];
        }
    }
}

void checkFields(const CellSoup& soup) {
    for (const Field& field : soup.fields) {
        const std::size_t places = field.association == Association::Point ? soup.points.size() : soup.cellCount();
        const std::size_t names = field.componentNames.size();
        if (names != 0 && names != static_cast<std::size_t>(field.components)) {
            throw std::runtime_error(fmt::format(
                "field '{}' has {} components with {} names; this is a fault of the reader, please report it",
                field.name, field.components, names));
        }
        if (field.components < 1 || field.values.size() != places * static_cast<std::size_t>(field.components)) {
            throw std::runtime_error(
                fmt::format("field '{}' has {} values for {} {} of {} components; write the file again", field.name,
                            field.values.size(), places, field.association == Association::Point ? "points" : "cells",
                            field.components));
        }
    }
}

}  // namespace

void checkStructure(const CellSoup& soup) {
    if (soup.points.size() >= CellSoup::invalidPoint || soup.cellCount() >= CellSoup::invalidPoint) {
        throw std::runtime_error("more points or cells than 32 bits can number; split the mesh into parts");
    }
    if (!soup.types.empty()) {
        checkOffsets(soup.offsets, soup.types.size(), soup.connectivity.size(), "point lists");
    }
    if (!soup.faceOffsets.empty()) {
        checkOffsets(soup.faceOffsets, soup.types.size(), soup.faceStream.size(), "polyhedron faces");
    }
    if (!soup.tetrahedra.empty() && !soup.types.empty()) {
        throw std::runtime_error("its reader gave its cells twice; this is a fault of the reader, please report it");
    }
    if (!soup.hidden.empty() && soup.hidden.size() != soup.cellCount()) {
        throw std::runtime_error("its ghost flags are not one per cell; write the file again");
    }
    checkFields(soup);
}

void correctTypes(CellSoup& soup) {
    for (std::size_t cell = 0; cell < soup.types.size(); ++cell) {
        soup.types[cell] =
            typeOfShape(soup.types[cell], static_cast<std::size_t>(soup.offsets[cell + 1] - soup.offsets[cell]));
    }
}

std::vector<CellVerdict> classifyCells(const CellSoup& soup) {
    std::vector<CellVerdict> verdicts(soup.types.size());
    tbb::parallel_for(Range(0, verdicts.size(), grain), [&](const Range& range) {
        for (std::size_t cell = range.begin(); cell != range.end(); ++cell) {
            verdicts[cell] = classifyCell(soup, cell);
        }
    });
    return verdicts;
}

void reportCells(const std::vector<std::uint8_t>& types, const std::vector<CellVerdict>& verdicts, MeshReport& report) {
    report.cellsRead += types.size();
    reportTypes(types, report);
    reportVerdicts([&](std::size_t cell) { return types[cell]; }, verdicts, report);
}

void reportTetrahedra(std::size_t count, const std::vector<CellVerdict>& verdicts, MeshReport& report) {
    report.cellsRead += count;
    report.cellTypes[cellTypeInfo(cell_type::tetrahedron).name] += count;
    reportVerdicts([](std::size_t) { return cell_type::tetrahedron; }, verdicts, report);
}

std::vector<std::uint8_t> namedPoints(const CellSoup& soup) {
    std::vector<std::uint8_t> used(soup.points.size(), 0);
    const auto mark = [&](std::uint32_t p) {
        if (p < used.size()) {
            setMark(used[p]);
        }
    };
    tbb::parallel_for(Range(0, soup.connectivity.size(), grain), [&](const Range& range) {
        for (std::size_t i = range.begin(); i != range.end(); ++i) {
            mark(soup.connectivity[i]);  // a polyhedron's points stand there too
        }
    });
    tbb::parallel_for(Range(0, soup.tetrahedra.size(), grain), [&](const Range& range) {
        for (std::size_t i = range.begin(); i != range.end(); ++i) {
            std::for_each(soup.tetrahedra[i].begin(), soup.tetrahedra[i].end(), mark);
        }
    });
    return used;
}

void reportUnusedPoints(const std::vector<std::uint8_t>& used, MeshReport& report) {
    for (std::size_t p = 0; p < used.size(); ++p) {
        if (used[p] == 0) {
            report.add(Defect::UnusedPoint, p);
        }
    }
}

}  // namespace tetralux::mesh
