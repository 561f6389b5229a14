// SPDX-License-Identifier: Apache-2.0
#include <mesh/soup/cell_decomposition.h>

#include <algorithm>
#include <atomic>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <mesh/soup/cell_types.h>
#include <mesh/soup/cone_decomposition.h>
#include <mesh/soup/face_triangulation.h>
#include <mesh/soup/polyhedron_surface.h>
#include <mesh/tet/duplicate_cells.h>
#include <mesh/tet/orientation.h>
#include <mesh/tet/shared_mark.h>

namespace tetralux::mesh {
namespace {

/// Turns the tetrahedron round if need be. \returns Good, Inverted, Flat, IndexOutOfRange or NonFinitePosition.
CellVerdict orientTetrahedron(std::span<const glm::dvec3> points, Tetrahedron& cell) {
    if (*std::max_element(cell.begin(), cell.end()) >= points.size()) {
        return CellVerdict::IndexOutOfRange;
    }
    const int side = orientation(points[cell[0]], points[cell[1]], points[cell[2]], points[cell[3]]);
    if (side < 0) {
        std::swap(cell[2], cell[3]);
    }
    if (side == 0) {
        const bool finite =
            std::all_of(cell.begin(), cell.end(), [&](PointIndex p) { return isFinitePosition(points[p]); });
        return finite ? CellVerdict::Flat : CellVerdict::NonFinitePosition;
    }
    return side > 0 ? CellVerdict::Good : CellVerdict::Inverted;
}

void markUsed(const Tetrahedron& cell, std::vector<std::uint8_t>& used) {
    for (const PointIndex p : cell) {
        if (p < used.size()) {
            setMark(used[p]);
        }
    }
}

/// Makes `worst` at least `found`.
void raise(std::atomic<CellVerdict>& worst, CellVerdict found) {
    CellVerdict before = worst.load(std::memory_order_relaxed);
    while (before < found && !worst.compare_exchange_weak(before, found, std::memory_order_relaxed)) {
    }
}

/// Leaves out points that repeat their predecessor: a collapsed edge.
void removeRepeats(std::vector<std::uint32_t>& polygon) {
    polygon.erase(std::unique(polygon.begin(), polygon.end()), polygon.end());
    while (polygon.size() > 1 && polygon.front() == polygon.back()) {
        polygon.pop_back();
    }
}

/// The faces of `cell` without collapsed edges and faces.
void collectFaces(const CellSoup& soup, std::size_t cell, std::vector<std::vector<std::uint32_t>>& faces) {
    std::size_t count = 0;
    forEachFace(soup, cell, [&](std::span<const std::uint32_t> face) {
        if (faces.size() == count) {
            faces.emplace_back();
        }
        faces[count].assign(face.begin(), face.end());
        removeRepeats(faces[count]);
        if (faces[count].size() >= 3) {
            ++count;
        }
    });
    faces.resize(count);
}

/// Whether writers agree on which way round cells of this type are numbered.
bool hasAgreedOrientation(std::uint8_t type) {
    return type != cell_type::wedge && type != cell_type::polyhedron;
}

CellVerdict decomposeCell(const CellSoup& soup, std::size_t cell, const FaceTriangulation& triangulation,
                          ConeOutput& out) {
    const std::uint8_t type = soup.types[cell];
    if (type == cell_type::tetrahedron) {
        Tetrahedron tetrahedron;
        std::copy_n(soup.connectivity.begin() + static_cast<std::ptrdiff_t>(soup.offsets[cell]), 4,
                    tetrahedron.begin());
        const CellVerdict verdict = orientTetrahedron(soup.points, tetrahedron);
        if (isKept(verdict)) {
            out.cells.push_back(tetrahedron);
        }
        return verdict;
    }
    thread_local std::vector<std::vector<std::uint32_t>> faces;
    thread_local std::vector<Triangle> surface;
    collectFaces(soup, cell, faces);
    if (type == cell_type::polyhedron && !makeFacesAgree(faces)) {
        return CellVerdict::Unsupported;
    }
    surface.clear();
    for (const std::vector<std::uint32_t>& face : faces) {
        triangulation.cut(face, surface);
    }
    return coneDecomposition(soup.points, surface, hasAgreedOrientation(type), out);
}

struct Block {
    ConeOutput out;
    std::vector<std::uint32_t> parents;
};

Block decomposeBlock(const CellSoup& soup, std::size_t begin, std::size_t end, const FaceTriangulation& triangulation,
                     std::vector<CellVerdict>& verdicts) {
    Block block;
    block.out.firstCentre = static_cast<std::uint32_t>(soup.points.size());
    for (std::size_t cell = begin; cell < end; ++cell) {
        if (isKept(verdicts[cell])) {
            verdicts[cell] = decomposeCell(soup, cell, triangulation, block.out);
            block.parents.resize(block.out.cells.size(), static_cast<std::uint32_t>(cell));
        }
    }
    return block;
}

/// Puts the blocks one behind the other, renumbers their new points and frees them on the way.
Decomposition joinBlocks(std::vector<Block>& blocks, CellSoup& soup) {
    Decomposition result;
    std::size_t cells = 0;
    for (const Block& block : blocks) {
        cells += block.out.cells.size();
    }
    result.cells.reserve(cells);
    result.parents.reserve(cells);
    PointBlends centres;
    const std::uint32_t first = static_cast<std::uint32_t>(soup.points.size());
    for (Block& block : blocks) {
        const std::uint32_t shift = static_cast<std::uint32_t>(centres.size());
        for (Tetrahedron cell : block.out.cells) {
            for (PointIndex& p : cell) {
                p += p >= first ? shift : 0;
            }
            result.cells.push_back(cell);
        }
        result.parents.insert(result.parents.end(), block.parents.begin(), block.parents.end());
        centres.append(block.out.centres);
        block = Block{};
    }
    appendBlendedPoints(soup, centres);
    return result;
}

}  // namespace

Decomposition takeTetrahedra(std::span<const glm::dvec3> points, std::vector<Tetrahedron>&& cells,
                             std::vector<CellVerdict>& verdicts, std::vector<std::uint8_t>& used) {
    Decomposition result{std::move(cells), {}, 0};
    verdicts.resize(result.cells.size());
    used.assign(points.size(), 0);
    DuplicateSearch search(result.cells.size(), points.size());
    std::atomic<CellVerdict> worst = CellVerdict::Good;
    const auto kept = [&](std::size_t i) { return isKept(verdicts[i]); };
    using Range = tbb::blocked_range<std::size_t>;
    tbb::parallel_for(Range(0, verdicts.size(), 16384), [&](const Range& range) {
        CellVerdict worstHere = CellVerdict::Good;
        for (std::size_t i = range.begin(); i != range.end(); ++i) {
            Tetrahedron& cell = result.cells[i];
            markUsed(cell, used);
            verdicts[i] = orientTetrahedron(points, cell);
            worstHere = std::max(worstHere, verdicts[i]);
            if (kept(i)) {
                search.note(cell);
            }
        }
        raise(worst, worstHere);
    });
    for (const std::uint32_t cell : search.find(result.cells, kept)) {
        verdicts[cell] = CellVerdict::Duplicate;
        worst = CellVerdict::Duplicate;
    }
    if (worst == CellVerdict::Good) {
        verdicts = {};
    }
    if (isKept(worst)) {
        return result;
    }
    std::size_t count = 0;
    for (std::size_t i = 0; i < verdicts.size(); ++i) {
        if (kept(i)) {
            result.cells[count++] = result.cells[i];
            result.parents.push_back(static_cast<std::uint32_t>(i));
        }
    }
    result.cells.resize(count);
    return result;
}

Decomposition decomposeCells(CellSoup& soup, std::vector<CellVerdict>& verdicts) {
    const FaceTriangulation triangulation(soup, verdicts);
    constexpr std::size_t blockSize = 8192;
    std::vector<Block> blocks((verdicts.size() + blockSize - 1) / blockSize);
    tbb::parallel_for(std::size_t{0}, blocks.size(), [&](std::size_t i) {
        const std::size_t end = std::min(verdicts.size(), (i + 1) * blockSize);
        blocks[i] = decomposeBlock(soup, i * blockSize, end, triangulation, verdicts);
    });
    // Before the tetrahedra are copied, which needs the most memory of all.
    soup.offsets = {};
    soup.connectivity = {};
    soup.faceOffsets = {};
    soup.faceStream = {};
    Decomposition result = joinBlocks(blocks, soup);
    result.facesFitted = triangulation.facesFitted();
    return result;
}

}  // namespace tetralux::mesh
