// SPDX-License-Identifier: Apache-2.0
#include <tetralux/mesh.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <string>
#include <utility>

#include <fmt/format.h>

#include <mesh/soup/cell_decomposition.h>
#include <mesh/soup/cell_types.h>
#include <mesh/soup/validation.h>
#include <mesh/tet/select_scalar.h>
#include <projection/renderer/errors.h>
#include <projection/renderer/mesh_data.h>

namespace tetralux {

namespace {

using mesh::SharedArray;
using mesh::Tetrahedron;

[[noreturn]] void refuse(const std::string& what) {
    throw Error(Errc::BadInput, what);
}

/// The same memory, as points.
std::span<const glm::dvec3> seenAsPoints(std::span<const double> xyz) {
    static_assert(sizeof(glm::dvec3) == 3 * sizeof(double) && alignof(glm::dvec3) <= alignof(double));
    return {reinterpret_cast<const glm::dvec3*>(xyz.data()), xyz.size() / 3};  // NOLINT: the layout is the same
}
std::span<const Tetrahedron> seenAsTetrahedra(std::span<const std::uint32_t> cells) {
    static_assert(sizeof(Tetrahedron) == 4 * sizeof(std::uint32_t));
    return {reinterpret_cast<const Tetrahedron*>(cells.data()), cells.size() / 4};  // NOLINT: likewise
}

void checkTriples(std::size_t numbers) {
    if (numbers % 3 != 0)
        refuse(fmt::format("points: {} numbers are no whole number of points; give x, y, z of each", numbers));
    if (numbers / 3 >= std::numeric_limits<std::uint32_t>::max())
        refuse(fmt::format("points: {} are more than 32-bit numbers tell apart; give the mesh in parts", numbers / 3));
}

/// A copy of its own, in double. \throws Error unless there are three numbers for each.
std::vector<glm::dvec3> pointsOf(std::span<const double> xyz) {
    checkTriples(xyz.size());
    const auto points = seenAsPoints(xyz);
    return {points.begin(), points.end()};
}
std::vector<glm::dvec3> pointsOf(std::span<const float> xyz) {
    checkTriples(xyz.size());
    std::vector<glm::dvec3> points(xyz.size() / 3);
    for (std::size_t i = 0; i < points.size(); ++i) points[i] = {xyz[3 * i], xyz[3 * i + 1], xyz[3 * i + 2]};
    return points;
}

std::shared_ptr<const Mesh> finished(Mesh::Data data) {
    data.bounds = mesh::usedBounds(data.positions, data.cells);
    return std::make_shared<const Mesh>(std::make_unique<Mesh::Data>(std::move(data)));
}

constexpr const char* numberName = "source number";

mesh::Field numbersOf(mesh::Association association, std::size_t count) {
    mesh::Field field{numberName, association, 1, std::vector<double>(count), true};
    for (std::size_t i = 0; i < count; ++i) field.values[i] = static_cast<double>(i);
    return field;
}

std::vector<std::uint32_t> numbersIn(const mesh::TetMesh& checked, mesh::Association association) {
    std::vector<std::uint32_t> numbers;
    for (const mesh::Field& field : checked.fields)
        if (field.association == association)
            for (const double value : field.values) numbers.push_back(static_cast<std::uint32_t>(value));
    return numbers;
}

/// Cells of any kind, checked. Their points and cells carry their numbers along, so that any field can follow.
std::shared_ptr<const Mesh> meshOfSoup(mesh::CellSoup soup, MeshReport* report) {
    Mesh::Data data;
    data.sourcePoints = soup.points.size();
    data.sourceCells = soup.cellCount();
    const bool curved = std::any_of(soup.types.begin(), soup.types.end(), [](std::uint8_t type) {
        return mesh::cellTypeInfo(type).shape != mesh::Shape::None && !mesh::cellTypeInfo(type).linear;
    });
    if (curved)
        data.curved = soup;
    else
        for (const auto association : {mesh::Association::Point, mesh::Association::Cell})
            soup.fields.push_back(
                numbersOf(association, association == mesh::Association::Point ? data.sourcePoints : data.sourceCells));
    mesh::ReadResult checked = mesh::tetMeshFromSoup(std::move(soup));
    if (!curved) {
        data.pointOf = numbersIn(checked.mesh, mesh::Association::Point);
        data.cellOf = numbersIn(checked.mesh, mesh::Association::Cell);
    }
    data.positions = std::move(checked.mesh.positions);
    data.cells = std::move(checked.mesh.cells);
    if (report != nullptr) *report = renderer::publicReport(checked.report);
    return finished(std::move(data));
}

std::shared_ptr<const Mesh> meshOfTetrahedra(SharedArray<glm::dvec3> points, std::span<const std::uint32_t> numbers,
                                             const std::shared_ptr<const void>& owner, MeshReport* report) {
    if (numbers.size() % 4 != 0)
        refuse(fmt::format("cells: {} numbers are no whole number of tetrahedra; give four points of each",
                           numbers.size()));
    const std::span<const Tetrahedron> given = seenAsTetrahedra(numbers);
    std::vector<mesh::CellVerdict> verdicts;
    std::vector<std::uint8_t> used;
    mesh::Decomposition taken =
        mesh::takeTetrahedra(points, std::vector<Tetrahedron>(given.begin(), given.end()), verdicts, used);
    const bool sound = taken.parents.empty() && !taken.cells.empty() &&
                       std::all_of(used.begin(), used.end(), [](std::uint8_t u) { return u != 0; });
    if (!sound) {  // the long way, which counts and leaves out
        mesh::CellSoup soup;
        soup.points.assign(points.begin(), points.end());
        soup.tetrahedra.assign(given.begin(), given.end());
        return meshOfSoup(std::move(soup), report);
    }
    Mesh::Data data;
    data.sourcePoints = points.size();
    data.sourceCells = given.size();
    data.positions = std::move(points);
    if (verdicts.empty() && owner)
        data.cells = SharedArray<Tetrahedron>::borrowed(given, owner);
    else
        data.cells = std::move(taken.cells);
    if (report != nullptr) {
        *report = {};
        report->cellsRead = given.size();
        report->cellTypes["tetrahedron"] = given.size();
        const auto inverted = std::count(verdicts.begin(), verdicts.end(), mesh::CellVerdict::Inverted);
        if (inverted > 0)
            report->defects[mesh::defectName(mesh::Defect::InvertedCell)] = static_cast<std::uint64_t>(inverted);
    }
    return finished(std::move(data));
}

/// 64-bit numbers become what the soup counts in; what has no place there becomes its word for that.
template <class Number>
std::vector<std::uint32_t> pointNumbers(std::span<const Number> numbers) {
    std::vector<std::uint32_t> result(numbers.size());
    std::transform(numbers.begin(), numbers.end(), result.begin(), [](Number n) {
        const auto wide = static_cast<std::int64_t>(n);
        return wide >= 0 && wide < mesh::CellSoup::invalidPoint ? static_cast<std::uint32_t>(wide)
                                                                : mesh::CellSoup::invalidPoint;
    });
    return result;
}

template <class Number>
std::vector<std::uint64_t> offsetsOf(const char* what, std::span<const Number> offsets, std::size_t cells,
                                     std::size_t end) {
    if (offsets.size() != cells + 1)
        refuse(fmt::format("{}: {} of them for {} cells; give one more than cells, the last the end", what,
                           offsets.size(), cells));
    std::vector<std::uint64_t> result;
    result.reserve(offsets.size());
    Number last = 0;
    for (const Number offset : offsets) {
        if (offset < last || static_cast<std::uint64_t>(offset) > end)
            refuse(
                fmt::format("{}: {} after {} of {}; they must ascend within what they count", what, offset, last, end));
        result.push_back(static_cast<std::uint64_t>(last = offset));
    }
    return result;
}

template <class Number>
std::shared_ptr<const Mesh> meshOfCells(std::vector<glm::dvec3> points, std::span<const std::uint8_t> types,
                                        std::span<const Number> offsets, std::span<const Number> connectivity,
                                        MeshReport* report, std::span<const std::int64_t> faceOffsets,
                                        std::span<const std::int64_t> faceStream) {
    mesh::CellSoup soup;
    soup.points = std::move(points);
    soup.types.assign(types.begin(), types.end());
    soup.offsets = offsetsOf("offsets", offsets, types.size(), connectivity.size());
    soup.connectivity = pointNumbers(connectivity);
    if (!faceOffsets.empty() || !faceStream.empty()) {
        soup.faceOffsets = offsetsOf("face offsets", faceOffsets, types.size(), faceStream.size());
        soup.faceStream = pointNumbers(faceStream);
    }
    return meshOfSoup(std::move(soup), report);
}

/// The field's values for the points or tetrahedra that are drawn.
SharedArray<double> valuesFor(const std::vector<std::uint32_t>& sourceOf, std::size_t count, const Field& field) {
    if (sourceOf.empty() && count == field.values().size())
        return SharedArray<double>::borrowed(field.values(), field.owner());
    std::vector<double> values(count);
    for (std::size_t i = 0; i < count; ++i) values[i] = field.values()[sourceOf[i]];
    return values;
}

/// The same where the mesh has curved cells, whose pieces' corners take what the cells' shape functions say.
SharedArray<double> valuesOfPieces(const mesh::CellSoup& curved, const Field& field) {
    mesh::CellSoup soup = curved;
    soup.fields.push_back({"", field.isOnPoints() ? mesh::Association::Point : mesh::Association::Cell, 1,
                           std::vector<double>(field.values().begin(), field.values().end()), false});
    mesh::ReadResult checked = mesh::tetMeshFromSoup(std::move(soup));
    return std::move(checked.mesh.fields.front().values);
}

template <class Number>
std::shared_ptr<std::vector<double>> doubles(std::span<const Number> values) {
    return std::make_shared<std::vector<double>>(values.begin(), values.end());
}

}  // namespace

double BoundingBox::diagonal() const {
    return std::hypot(high[0] - low[0], high[1] - low[1], high[2] - low[2]);
}

Mesh::Mesh(std::unique_ptr<Data> data) : data_(std::move(data)) {}
Mesh::~Mesh() = default;

std::size_t Mesh::tetrahedra() const {
    return data_->cells.size();
}
std::span<const double> Mesh::positions() const {
    return {&data_->positions.data()->x, 3 * data_->positions.size()};
}
std::span<const std::uint32_t> Mesh::corners() const {
    return {data_->cells.data()->data(), 4 * data_->cells.size()};
}
std::size_t Mesh::points() const {
    return data_->sourcePoints;
}
std::size_t Mesh::cells() const {
    return data_->sourceCells;
}
BoundingBox Mesh::bounds() const {
    const auto& [low, high] = data_->bounds;
    return {{low.x, low.y, low.z}, {high.x, high.y, high.z}};
}

std::shared_ptr<const Mesh> Mesh::fromTetrahedra(std::span<const double> xyz, std::span<const std::uint32_t> cells,
                                                 MeshReport* report) {
    return renderer::translated([&] { return meshOfTetrahedra(pointsOf(xyz), cells, nullptr, report); });
}

std::shared_ptr<const Mesh> Mesh::fromTetrahedra(std::span<const float> xyz, std::span<const std::uint32_t> cells,
                                                 MeshReport* report) {
    return renderer::translated([&] { return meshOfTetrahedra(pointsOf(xyz), cells, nullptr, report); });
}

std::shared_ptr<const Mesh> Mesh::borrow(std::span<const double> xyz, std::span<const std::uint32_t> cells,
                                         std::shared_ptr<const void> owner, MeshReport* report) {
    return renderer::translated([&] {
        checkTriples(xyz.size());
        return meshOfTetrahedra(SharedArray<glm::dvec3>::borrowed(seenAsPoints(xyz), owner), cells, owner, report);
    });
}

std::shared_ptr<const Mesh> Mesh::fromCells(std::span<const double> xyz, std::span<const std::uint8_t> types,
                                            std::span<const std::int64_t> offsets,
                                            std::span<const std::int64_t> connectivity, MeshReport* report,
                                            std::span<const std::int64_t> faceOffsets,
                                            std::span<const std::int64_t> faceStream) {
    return renderer::translated(
        [&] { return meshOfCells(pointsOf(xyz), types, offsets, connectivity, report, faceOffsets, faceStream); });
}

std::shared_ptr<const Mesh> Mesh::fromCells(std::span<const float> xyz, std::span<const std::uint8_t> types,
                                            std::span<const std::int64_t> offsets,
                                            std::span<const std::int64_t> connectivity, MeshReport* report,
                                            std::span<const std::int64_t> faceOffsets,
                                            std::span<const std::int64_t> faceStream) {
    return renderer::translated(
        [&] { return meshOfCells(pointsOf(xyz), types, offsets, connectivity, report, faceOffsets, faceStream); });
}

std::shared_ptr<const Mesh> Mesh::fromCells(std::span<const double> xyz, std::span<const std::uint8_t> types,
                                            std::span<const std::int32_t> offsets,
                                            std::span<const std::int32_t> connectivity, MeshReport* report) {
    return renderer::translated(
        [&] { return meshOfCells(pointsOf(xyz), types, offsets, connectivity, report, {}, {}); });
}

Field::Field(bool onPoints, std::span<const double> values, std::shared_ptr<const void> owner)
    : onPoints_(onPoints), values_(values), owner_(std::move(owner)) {}

Field Field::borrowOnPoints(std::span<const double> values, std::shared_ptr<const void> owner) {
    return {true, values, std::move(owner)};
}
Field Field::borrowOnCells(std::span<const double> values, std::shared_ptr<const void> owner) {
    return {false, values, std::move(owner)};
}
Field Field::onPoints(std::span<const double> values) {
    const auto kept = doubles(values);
    return {true, *kept, kept};
}
Field Field::onPoints(std::span<const float> values) {
    const auto kept = doubles(values);
    return {true, *kept, kept};
}
Field Field::onCells(std::span<const double> values) {
    const auto kept = doubles(values);
    return {false, *kept, kept};
}
Field Field::onCells(std::span<const float> values) {
    const auto kept = doubles(values);
    return {false, *kept, kept};
}

namespace renderer {

std::shared_ptr<const mesh::ScalarMesh> scalarMesh(const Mesh::Data& data, const Field& field, std::uint64_t& leftOut) {
    const std::size_t wanted = field.isOnPoints() ? data.sourcePoints : data.sourceCells;
    if (field.values().size() != wanted)
        refuse(fmt::format("field: {} values for {} {}; give one for each", field.values().size(), wanted,
                           field.isOnPoints() ? "points" : "cells"));
    mesh::ScalarMesh drawn;
    drawn.positions = data.positions;
    drawn.cells = data.cells;
    drawn.association = field.isOnPoints() ? mesh::Association::Point : mesh::Association::Cell;
    drawn.scalars = data.curved          ? valuesOfPieces(*data.curved, field)
                    : field.isOnPoints() ? valuesFor(data.pointOf, data.positions.size(), field)
                                         : valuesFor(data.cellOf, data.cells.size(), field);
    mesh::MeshReport report;
    leftOut = mesh::finishScalars(drawn, report);
    if (drawn.cells.empty()) refuse("field: NaN, infinite or beyond 1e280 in every cell; give values that are finite");
    return std::make_shared<const mesh::ScalarMesh>(std::move(drawn));
}

std::shared_ptr<const Mesh> checkedMesh(SharedArray<glm::dvec3> positions, SharedArray<Tetrahedron> cells) {
    Mesh::Data data;
    data.sourcePoints = positions.size();
    data.sourceCells = cells.size();
    data.positions = std::move(positions);
    data.cells = std::move(cells);
    return finished(std::move(data));
}

MeshReport publicReport(const mesh::MeshReport& report) {
    MeshReport result;
    result.cellsRead = report.cellsRead;
    result.cellTypes = report.cellTypes;
    result.skipped = report.skipped;
    for (const auto& [defect, found] : report.defects) result.defects[mesh::defectName(defect)] = found.count;
    return result;
}

}  // namespace renderer
}  // namespace tetralux
