// SPDX-License-Identifier: Apache-2.0
#include <mesh/soup/mesh_shaping.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <mesh/soup/block_names.h>
#include <mesh/soup/validation.h>
#include <mesh/tet/select_scalar.h>

namespace tetralux::mesh {
namespace {

/// What is left out, by cell.
using Left = std::vector<std::uint8_t>;

/// Cell fields that name parts: those with names first, then those called as parts are.
std::vector<const Field*> partFields(const ReadResult& result) {
    std::set<std::string> named;
    for (const BlockName& block : result.blockNames) named.insert(block.field);
    std::vector<const Field*> fields;
    for (const bool byName : {true, false})
        for (const Field& field : result.mesh.fields) {
            if (field.association != Association::Cell || field.components != 1 || named.contains(field.name) != byName)
                continue;
            static const std::set<std::string> usual{blockFieldName, "physical", "region",
                                                     "material",     "entity",   "zone"};
            if (byName || usual.contains(field.name)) fields.push_back(&field);
        }
    return fields;
}

std::optional<double> numberOf(const std::string& text) {
    try {
        std::size_t end = 0;
        const double number = std::stod(text, &end);
        return end == text.size() ? std::optional(number) : std::nullopt;
    } catch (const std::exception&) {
        return std::nullopt;
    }
}

/// Marks the cells of the block called `name` (or, where none is, with that number).
void markBlock(const ReadResult& result, const std::string& name, Left& marks) {
    bool found = false;
    const auto mark = [&](const Field& field, double number) {
        for (std::size_t cell = 0; cell < marks.size(); ++cell)
            if (field.values[cell] == number) {
                marks[cell] = 1;
                found = true;
            }
    };
    const std::vector<const Field*> fields = partFields(result);
    for (const BlockName& block : result.blockNames)
        for (const Field* field : fields)
            if (block.name == name && block.field == field->name) mark(*field, block.number);
    if (const auto number = numberOf(name); number && !found && !fields.empty()) mark(*fields.front(), *number);
    if (!found) {
        const std::vector<std::string> known = blockList(result);
        throw std::runtime_error(
            known.empty() ? fmt::format("no block '{}': the mesh does not say which parts it has; leave it out", name)
                          : fmt::format("no block '{}'; the mesh has {}", name, fmt::join(known, ", ")));
    }
}

void leaveOutBlocks(const ReadResult& result, const MeshShaping& shaping, Left& left) {
    if (!shaping.blocks.empty()) {
        Left wanted(left.size(), 0);
        for (const std::string& name : shaping.blocks) markBlock(result, name, wanted);
        for (std::size_t cell = 0; cell < left.size(); ++cell)
            if (wanted[cell] == 0) left[cell] = 1;
    }
    for (const std::string& name : shaping.hiddenBlocks) markBlock(result, name, left);
}

void leaveOutBeyond(const TetMesh& mesh, const Threshold& threshold, Left& left) {
    const ChosenScalar scalar = scalarOf(mesh, threshold.field);
    const auto within = [&](std::size_t place) {
        return scalar.values[place] >= threshold.low && scalar.values[place] <= threshold.high;
    };
    for (std::size_t cell = 0; cell < left.size(); ++cell) {
        const Tetrahedron& corners = mesh.cells[cell];
        const bool keeps = scalar.association == Association::Cell
                               ? within(cell)
                               : std::all_of(corners.begin(), corners.end(), within);
        if (!keeps) left[cell] = 1;
    }
}

void keepOthers(TetMesh& mesh, const Left& left) {
    const auto keepOf = [&](auto& values, std::size_t each) {
        std::size_t kept = 0;
        for (std::size_t cell = 0; cell < left.size(); ++cell) {
            if (left[cell] != 0) continue;
            std::copy_n(values.begin() + static_cast<std::ptrdiff_t>(cell * each), each,
                        values.begin() + static_cast<std::ptrdiff_t>(kept * each));
            ++kept;
        }
        values.resize(kept * each);
    };
    for (Field& field : mesh.fields)
        if (field.association == Association::Cell) keepOf(field.values, static_cast<std::size_t>(field.components));
    keepOf(mesh.cells, 1);
}

void warpPoints(TetMesh& mesh, const Warp& warp) {
    const auto found = std::find_if(mesh.fields.begin(), mesh.fields.end(), [&](const Field& field) {
        return field.name == warp.field && field.association == Association::Point && field.components == 3;
    });
    if (found == mesh.fields.end()) {
        std::vector<std::string> vectors;
        for (const Field& field : mesh.fields)
            if (field.association == Association::Point && field.components == 3) vectors.push_back(field.name);
        throw std::runtime_error(fmt::format("no vector field on points named '{}' to warp by; the mesh has {}",
                                             warp.field,
                                             vectors.empty() ? "none" : fmt::format("{}", fmt::join(vectors, ", "))));
    }
    for (std::size_t point = 0; point < mesh.positions.size(); ++point) {
        const double* const way = found->values.data() + 3 * point;
        mesh.positions[point] += warp.factor * glm::dvec3(way[0], way[1], way[2]);
    }
}

/// Checks the mesh again as if it had been read so; what is found is added to the report.
void checkAgain(ReadResult& result) {
    CellSoup soup;
    soup.points = std::move(result.mesh.positions);
    soup.tetrahedra = std::move(result.mesh.cells);
    soup.fields = std::move(result.mesh.fields);
    ReadResult checked = tetMeshFromSoup(std::move(soup));
    result.mesh = std::move(checked.mesh);
    for (const auto& [reason, count] : checked.report.skipped) result.report.skipped[reason] += count;
}

}  // namespace

void shapeMesh(ReadResult& result, const MeshShaping& shaping) {
    if (shaping.none()) return;
    Left left(result.mesh.cells.size(), 0);
    leaveOutBlocks(result, shaping, left);
    for (const Threshold& threshold : shaping.thresholds) leaveOutBeyond(result.mesh, threshold, left);
    const auto gone = static_cast<std::uint64_t>(std::count(left.begin(), left.end(), 1));
    if (gone == left.size())
        throw std::runtime_error("blocks and thresholds leave no cell; take more blocks, or a wider threshold");
    if (gone > 0) keepOthers(result.mesh, left);
    if (shaping.warp) warpPoints(result.mesh, *shaping.warp);
    if (shaping.scale)
        for (glm::dvec3& point : result.mesh.positions) point *= *shaping.scale;
    checkAgain(result);
    if (gone > 0) result.report.skipped["not among the blocks or beyond a threshold"] += gone;
}

std::vector<std::string> blockList(const ReadResult& result) {
    std::vector<std::string> list;
    for (const Field* field : partFields(result)) {
        const std::set<double> numbers(field->values.begin(), field->values.end());
        if (numbers.size() > 1000) continue;  // no parts
        for (const double number : numbers) {
            if (!std::isfinite(number)) continue;
            const auto name = std::find_if(
                result.blockNames.begin(), result.blockNames.end(),
                [&](const BlockName& block) { return block.field == field->name && block.number == number; });
            list.push_back(name != result.blockNames.end()
                               ? fmt::format("'{}' ({} {:g})", name->name, field->name, number)
                               : fmt::format("{} {:g}", field->name, number));
        }
        break;  // those of the first field that tells
    }
    return list;
}

}  // namespace tetralux::mesh
