// SPDX-License-Identifier: Apache-2.0
#include <mesh/soup/validation.h>

#include <algorithm>
#include <cstring>
#include <stdexcept>

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <mesh/soup/append_soup.h>
#include <mesh/soup/cell_decomposition.h>
#include <mesh/soup/cell_types.h>
#include <mesh/soup/merge_points.h>
#include <mesh/soup/smooth_cells.h>
#include <mesh/soup/soup_checks.h>
#include <mesh/soup/subdivide_cells.h>
#include <mesh/tet/duplicate_cells.h>

namespace tetralux::mesh {
namespace {

/// Drops repeated tetrahedra. A source cell is counted once, however many tetrahedra it became.
void dropDuplicates(Decomposition& decomposition, std::size_t pointCount, MeshReport& report) {
    DuplicateSearch search(decomposition.cells.size(), pointCount);
    const auto all = [](std::size_t) { return true; };
    tbb::parallel_for(std::size_t{0}, decomposition.cells.size(),
                      [&](std::size_t i) { search.note(decomposition.cells[i]); });
    const std::vector<std::uint32_t> duplicates = search.find(decomposition.cells, all);
    if (duplicates.empty()) {
        return;
    }
    std::size_t kept = 0;
    auto duplicate = duplicates.begin();
    std::uint64_t lastCounted = ~std::uint64_t{0};
    for (std::size_t i = 0; i < decomposition.cells.size(); ++i) {
        const std::uint32_t parent = decomposition.parents[i];
        if (duplicate == duplicates.end() || *duplicate != i) {
            decomposition.cells[kept] = decomposition.cells[i];
            decomposition.parents[kept++] = parent;
            continue;
        }
        ++duplicate;
        if (parent != lastCounted) {
            report.add(Defect::DuplicateCell, parent);
            ++report.skipped[defectName(Defect::DuplicateCell)];
            lastCounted = parent;
        }
    }
    decomposition.cells.resize(kept);
    decomposition.parents.resize(kept);
}

/// Values of the tetrahedra's parents in place of the parents' own.
void spreadCellField(Field& field, const Decomposition& decomposition) {
    if (decomposition.parents.empty()) {
        return;
    }
    const std::size_t components = static_cast<std::size_t>(field.components);
    std::vector<double> values(decomposition.cells.size() * components);
    tbb::parallel_for(std::size_t{0}, decomposition.cells.size(), [&](std::size_t i) {
        std::copy_n(field.values.data() + decomposition.parents[i] * components, components,
                    values.data() + i * components);
    });
    field.values = std::move(values);
}

/// Removes points that no tetrahedron uses; the order of the others stays.
void dropUnusedPoints(TetMesh& mesh) {
    constexpr PointIndex unused = 0xffffffffu;
    std::vector<PointIndex> renumbered(mesh.positions.size(), unused);
    for (const Tetrahedron& cell : mesh.cells) {
        for (const PointIndex p : cell) {
            renumbered[p] = 0;
        }
    }
    PointIndex count = 0;
    for (PointIndex& p : renumbered) {
        if (p != unused) {
            p = count++;
        }
    }
    if (count == mesh.positions.size()) {
        return;
    }
    for (Field& field : mesh.fields) {
        if (field.association == Association::Point) {
            const std::size_t components = static_cast<std::size_t>(field.components);
            for (std::size_t p = 0; p < renumbered.size(); ++p) {
                if (renumbered[p] != unused) {
                    std::copy_n(field.values.data() + p * components, components,
                                field.values.data() + renumbered[p] * components);
                }
            }
            field.values.resize(count * components);
        }
    }
    for (std::size_t p = 0; p < renumbered.size(); ++p) {
        if (renumbered[p] != unused) {
            mesh.positions[renumbered[p]] = mesh.positions[p];
        }
    }
    mesh.positions.resize(count);
    tbb::parallel_for(std::size_t{0}, mesh.cells.size(), [&](std::size_t i) {
        for (PointIndex& p : mesh.cells[i]) {
            p = renumbered[p];
        }
    });
}

[[noreturn]] void refuseEmpty(const MeshReport& report) {
    if (report.cellsRead == 0) {
        throw std::runtime_error("holds no cells; give a mesh with at least one solid cell");
    }
    std::string reasons;
    bool onlySurface = true;
    for (const auto& [reason, count] : report.skipped) {
        reasons += fmt::format("{}{} {}", reasons.empty() ? "" : ", ", count, reason);
        onlySurface = onlySurface && reason.starts_with("not solid");
    }
    throw std::runtime_error(fmt::format("no solid cell is left of {}: {}; {}", report.cellsRead, reasons,
                                         onlySurface ? "make tetrahedra of the surface with `tetralux mesh`"
                                                     : "mend the cells or export the mesh again"));
}

/// What is to be said of a source cell: the worst that was found of its pieces, but flat only if all of them are.
CellVerdict joined(CellVerdict before, CellVerdict piece) {
    const auto rank = [](CellVerdict v) { return isKept(v) ? static_cast<int>(v) : -1; };
    return rank(piece) > rank(before) ? piece : before;
}

/// Decomposition of the pieces of curved cells, with source cells as parents and verdicts of source cells.
Decomposition decomposePieces(CellSoup& soup, const std::vector<std::uint32_t>& sources,
                              std::vector<CellVerdict>& verdicts) {
    std::vector<CellVerdict> pieces(soup.types.size(), CellVerdict::Good);
    Decomposition decomposition = decomposeCells(soup, pieces);
    if (decomposition.parents.empty()) {
        decomposition.parents = sources;
    } else {
        for (std::uint32_t& parent : decomposition.parents) {
            parent = sources[parent];
        }
    }
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        const bool first = i == 0 || sources[i] != sources[i - 1];
        verdicts[sources[i]] = first ? pieces[i] : joined(verdicts[sources[i]], pieces[i]);
    }
    return decomposition;
}

/// Turns a soup of nothing but tetrahedra into the form that holds just these, so that the rest is quick and needs
/// little memory.
void preferTetrahedra(CellSoup& soup) {
    const auto isTetrahedron = [](std::uint8_t type) { return type == cell_type::tetrahedron; };
    if (soup.types.empty() || !soup.hidden.empty() || soup.connectivity.size() != 4 * soup.types.size() ||
        !std::all_of(soup.types.begin(), soup.types.end(), isTetrahedron)) {
        return;
    }
    for (std::size_t i = 0; i < soup.offsets.size(); ++i) {
        if (soup.offsets[i] != 4 * i) {
            return;
        }
    }
    soup.types = {};
    soup.offsets = {};
    soup.tetrahedra.resize(soup.connectivity.size() / 4);
    std::memcpy(soup.tetrahedra.data(), soup.connectivity.data(), soup.connectivity.size() * sizeof(std::uint32_t));
    soup.connectivity = {};
}

/// `decompose` for a soup that holds just tetrahedra.
Decomposition decomposeTetrahedra(CellSoup& soup, const ReadOptions& options, MeshReport& report) {
    const Representatives representatives = findCoincidentPoints(soup, options.mergeTolerance, report);
    if (!representatives.empty()) {
        reportUnusedPoints(namedPoints(soup), report);
        mergePoints(soup, representatives);
    }
    const std::size_t count = soup.tetrahedra.size();
    std::vector<CellVerdict> verdicts;
    std::vector<std::uint8_t> used;
    Decomposition decomposition = takeTetrahedra(soup.points, std::move(soup.tetrahedra), verdicts, used);
    if (representatives.empty()) {
        reportUnusedPoints(used, report);
    }
    reportTetrahedra(count, verdicts, report);
    return decomposition;
}

/// Everything that is done to cells.
Decomposition decompose(CellSoup& soup, const ReadOptions& options, MeshReport& report) {
    if (!options.smoothCells) {
        preferTetrahedra(soup);
    } else {
        preferGeneralCells(soup);
    }
    if (!soup.tetrahedra.empty()) {
        return decomposeTetrahedra(soup, options, report);
    }
    std::vector<CellVerdict> verdicts = classifyCells(soup);
    reportUnusedPoints(namedPoints(soup), report);
    mergePoints(soup, findCoincidentPoints(soup, options.mergeTolerance, report));
    if (options.smoothCells) {
        smoothCellFields(soup, verdicts);
    }
    const std::vector<std::uint8_t> types = soup.types;
    const auto sources = subdivideCurvedCells(soup, verdicts, options.subdivision);
    Decomposition decomposition = sources ? decomposePieces(soup, *sources, verdicts) : decomposeCells(soup, verdicts);
    report.facesFitted += decomposition.facesFitted;
    reportCells(types, verdicts, report);
    dropDuplicates(decomposition, soup.points.size(), report);
    return decomposition;
}

}  // namespace

ReadResult tetMeshFromSoup(CellSoup soup, const ReadOptions& options) {
    checkStructure(soup);
    correctTypes(soup);
    ReadResult result;
    result.times = std::move(soup.times);
    result.report.notes = std::move(soup.notes);
    result.blockNames = std::move(soup.blockNames);
    const std::size_t sourcePoints = soup.points.size();
    Decomposition decomposition = decompose(soup, options, result.report);
    // The common case, a sound mesh of tetrahedra, is spared the search.
    const bool mayHaveUnusedPoints = !decomposition.parents.empty() || sourcePoints != soup.points.size() ||
                                     result.report.pointsMerged > 0 ||
                                     result.report.defects.contains(Defect::UnusedPoint);
    soup.types = {};
    soup.offsets = {};
    soup.connectivity = {};
    soup.faceOffsets = {};
    soup.faceStream = {};
    if (decomposition.cells.empty()) {
        refuseEmpty(result.report);
    }
    for (Field& field : soup.fields) {
        if (field.association == Association::Cell) {
            spreadCellField(field, decomposition);
        }
    }
    result.mesh = {std::move(soup.points), std::move(decomposition.cells), std::move(soup.fields)};
    if (mayHaveUnusedPoints) {
        dropUnusedPoints(result.mesh);
    }
    return result;
}

}  // namespace tetralux::mesh
