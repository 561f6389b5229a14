// SPDX-License-Identifier: Apache-2.0
#include <mesh/tet/select_scalar.h>

#include <algorithm>
#include <atomic>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>

namespace tetralux::mesh {
namespace {

using Range = tbb::blocked_range<std::size_t>;
constexpr int magnitude = -1;

struct Choice {
    std::size_t field = 0;
    int component = magnitude;  ///< or the component taken
};

const char* placeName(Association association) {
    return association == Association::Point ? "points" : "cells";
}

std::string componentName(const Field& field, int component) {
    if (!field.componentNames.empty()) {
        return field.componentNames[static_cast<std::size_t>(component)];
    }
    return field.components <= 3 ? std::string(1, "xyz"[component]) : std::to_string(component);
}

std::string listOfFields(const TetMesh& mesh) {
    std::string list;
    for (const Field& field : mesh.fields) {
        const std::string shape = field.components == 1 ? "" : fmt::format(", {} components", field.components);
        list += fmt::format("{}'{}' ({}{})", list.empty() ? "" : ", ", field.name, placeName(field.association), shape);
    }
    return list;
}

/// Position of the field called `name` on `association`; fields.size() if there is none.
std::size_t findFieldOn(const std::vector<Field>& fields, std::string_view name, Association association) {
    const auto found = std::find_if(fields.begin(), fields.end(), [&](const Field& field) {
        return field.association == association && field.name == name;
    });
    return static_cast<std::size_t>(found - fields.begin());
}

/// Position of the field called `name`, point fields first, or of the one that "name@points" or "name@cells" means;
/// fields.size() if there is none.
std::size_t findField(const std::vector<Field>& fields, std::string_view name) {
    for (const Association association : {Association::Point, Association::Cell}) {
        if (const std::size_t found = findFieldOn(fields, name, association); found < fields.size()) {
            return found;
        }
    }
    const std::size_t at = name.rfind('@');
    for (const Association association : {Association::Point, Association::Cell}) {
        if (at != std::string_view::npos && name.substr(at + 1) == placeName(association)) {
            return findFieldOn(fields, name.substr(0, at), association);
        }
    }
    return fields.size();
}

/// Scaling overflows just beyond `largestScalar` (not before 1.7e280).
double finiteIfDrawable(double value) {
    constexpr double scale = 1e28;
    return value * scale;
}

/// Whether some cell has all its values.
bool isOnSomeCell(const TetMesh& mesh, const Field& field) {
    const std::size_t components = static_cast<std::size_t>(field.components);
    const auto isThere = [&](std::size_t place) {
        const double* const value = field.values.data() + place * components;
        return std::all_of(value, value + components, [](double v) { return std::isfinite(finiteIfDrawable(v)); });
    };
    for (std::size_t cell = 0; cell < mesh.cells.size(); ++cell) {
        const Tetrahedron& t = mesh.cells[cell];
        if (field.association == Association::Cell ? isThere(cell) : std::all_of(t.begin(), t.end(), isThere)) {
            return true;
        }
    }
    return false;
}

/// The first point field, else the first cell field, that is not mere numbers of points or cells and has a value on
/// some cell, be that one that no cell has a value of; fields.size() if there is none at all.
std::size_t firstField(const TetMesh& mesh) {
    const std::vector<Field>& fields = mesh.fields;
    std::size_t withoutValue = fields.size();
    for (const Association association : {Association::Point, Association::Cell}) {
        for (std::size_t i = 0; i < fields.size(); ++i) {
            if (fields[i].association != association || fields[i].bookkeeping) {
                continue;
            }
            if (isOnSomeCell(mesh, fields[i])) {
                return i;
            }
            withoutValue = std::min(withoutValue, i);
        }
    }
    return withoutValue;
}

/// A component by its name, else by its number ("0", "1", …) or as "x", "y", "z"; nothing that is no such name.
std::optional<int> findComponent(const Field& field, std::string_view text) {
    const auto named = std::find(field.componentNames.begin(), field.componentNames.end(), text);
    if (named != field.componentNames.end()) {
        return static_cast<int>(named - field.componentNames.begin());
    }
    int component = 0;
    const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), component);
    if (text.size() == 1 && text[0] >= 'x' && text[0] <= 'z') {
        component = text[0] - 'x';
    } else if (error != std::errc() || stop != text.data() + text.size()) {
        return std::nullopt;
    }
    return component >= 0 && component < field.components ? std::optional(component) : std::nullopt;
}

std::string listOfComponents(const Field& field) {
    std::string list = fmt::format("{} (0 to {}", field.components, field.components - 1);
    for (const std::string& name : field.componentNames) {
        list += ", " + name;
    }
    return list + ")";
}

/// The whole of `name` is tried first and then each colon from the right, so that names may have colons.
Choice chooseField(const TetMesh& mesh, const std::string& name) {
    if (name.empty()) {
        return {firstField(mesh), magnitude};
    }
    if (const std::size_t whole = findField(mesh.fields, name); whole < mesh.fields.size()) {
        return {whole, magnitude};
    }
    const std::string_view text = name;
    std::string refusal = fmt::format("no field named '{}'; the mesh has {}", name, listOfFields(mesh));
    for (std::size_t colon = text.rfind(':'); colon != std::string_view::npos && colon > 0;
         colon = text.rfind(':', colon - 1)) {
        const std::size_t found = findField(mesh.fields, text.substr(0, colon));
        if (found == mesh.fields.size()) {
            continue;
        }
        const Field& field = mesh.fields[found];
        if (const std::optional<int> component = findComponent(field, text.substr(colon + 1))) {
            return {found, *component};
        }
        refusal = fmt::format("field '{}' has no component '{}'; it has {}", field.name, text.substr(colon + 1),
                              listOfComponents(field));
    }
    throw std::runtime_error(refusal);
}

/// Euclidean norm that neither overflows nor vanishes where the result is representable.
double norm(const double* values, int count) {
    double largest = 0.0;
    for (int i = 0; i < count; ++i) {
        if (!std::isfinite(values[i])) {
            return values[i];
        }
        largest = std::max(largest, std::abs(values[i]));
    }
    if (largest == 0.0) {
        return 0.0;
    }
    double sum = 0.0;
    for (int i = 0; i < count; ++i) {
        const double ratio = values[i] / largest;
        sum += ratio * ratio;
    }
    return largest * std::sqrt(sum);
}

/// Adds the coordinate called `name` ("x", "y" or "z"), or that along which the mesh is longest if `name` is empty, as
/// a point field, so that a mesh without values can be shown at all.
void addCoordinateField(TetMesh& mesh, const std::string& name) {
    const BoundingBox box = usedBounds(mesh.positions, mesh.cells);
    const glm::dvec3 size = box.high - box.low;
    int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    axis = name.empty() ? axis : name[0] - 'x';
    Field field;
    field.name = std::string(1, static_cast<char>('x' + axis));
    field.values.reserve(mesh.positions.size());
    for (const glm::dvec3& position : mesh.positions) {
        field.values.push_back(position[axis]);
    }
    mesh.fields.push_back(std::move(field));
}

bool isCoordinateName(const std::string& name) {
    return name == "x" || name == "y" || name == "z";
}

/// One value per point or cell, taken out of `field` in place.
std::vector<double> takeScalars(Field& field, int component) {
    if (field.components > 1) {
        const std::size_t components = static_cast<std::size_t>(field.components);
        const std::size_t count = field.values.size() / components;
        for (std::size_t i = 0; i < count; ++i) {
            const double* tuple = field.values.data() + i * components;
            field.values[i] = component == magnitude ? norm(tuple, field.components) : tuple[component];
        }
        field.values.resize(count);
    }
    return std::move(field.values);
}

std::string fieldTitle(const Field& field, int component) {
    if (field.components == 1) {
        return field.name;
    }
    if (component == magnitude) {
        return field.name + " (magnitude)";
    }
    return fmt::format("{} ({})", field.name, componentName(field, component));
}

bool hasFiniteScalars(const ScalarMesh& mesh, std::size_t cell) {
    if (mesh.association == Association::Cell) {
        return std::isfinite(finiteIfDrawable(mesh.scalars[cell]));
    }
    const Tetrahedron& t = mesh.cells[cell];
    return std::all_of(t.begin(), t.end(),
                       [&](PointIndex p) { return std::isfinite(finiteIfDrawable(mesh.scalars[p])); });
}

bool areAllFinite(std::span<const double> values) {
    std::atomic<bool> finite = true;
    tbb::parallel_for(Range(0, values.size(), 65536), [&](const Range& range) {
        // 0 for every finite value, else NaN: without a branch this is many values at a time.
        double sum = 0.0;
        for (std::size_t i = range.begin(); i != range.end(); ++i) {
            sum += finiteIfDrawable(values[i]) * 0.0;
        }
        if (sum != 0.0) {
            finite.store(false, std::memory_order_relaxed);
        }
    });
    return finite;
}

/// Leaves out cells with a scalar that is NaN, infinite or too large; the order of the others stays. \returns how many.
std::uint64_t dropNonFiniteCells(ScalarMesh& mesh, MeshReport& report) {
    if (areAllFinite(mesh.scalars)) {
        return 0;
    }
    std::size_t kept = 0;
    for (std::size_t i = 0; i < mesh.cells.size(); ++i) {
        if (!hasFiniteScalars(mesh, i)) {
            report.add(Defect::NonFiniteScalar, i);
            continue;
        }
        mesh.cells[kept] = mesh.cells[i];
        if (mesh.association == Association::Cell) {
            mesh.scalars[kept] = mesh.scalars[i];
        }
        ++kept;
    }
    for (double& scalar : mesh.scalars)
        if (!std::isfinite(finiteIfDrawable(scalar))) scalar = std::numeric_limits<double>::quiet_NaN();
    const std::uint64_t dropped = mesh.cells.size() - kept;
    if (dropped > 0) {
        mesh.cells.resize(kept);
        if (mesh.association == Association::Cell) {
            mesh.scalars.resize(kept);
        }
        report.skipped[defectName(Defect::NonFiniteScalar)] += dropped;
    }
    return dropped;
}

/// Range of the scalar and bounds, of what cells use: every point unless cells have been dropped.
void findRangeAndBounds(ScalarMesh& mesh, bool allPointsUsed) {
    const std::vector<std::uint8_t> used = allPointsUsed ? std::vector<std::uint8_t>(mesh.positions.size(), 1)
                                                         : usedPoints(mesh.cells, mesh.positions.size());
    mesh.bounds = usedBounds(mesh.positions, used);
    const bool onPoints = mesh.association == Association::Point;
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const auto [low, high] = tbb::parallel_reduce(
        Range(0, mesh.scalars.size(), 65536), std::pair(infinity, -infinity),
        [&](const Range& range, std::pair<double, double> found) {
            for (std::size_t i = range.begin(); i != range.end(); ++i) {
                if (!onPoints || used[i] != 0) {
                    found = {std::min(found.first, mesh.scalars[i]), std::max(found.second, mesh.scalars[i])};
                }
            }
            return found;
        },
        [](const auto& a, const auto& b) {
            return std::pair(std::min(a.first, b.first), std::max(a.second, b.second));
        });
    mesh.scalarMin = low;
    mesh.scalarMax = high;
}

}  // namespace

ChosenScalar scalarOf(const TetMesh& mesh, const std::string& name) {
    const std::size_t found = name.empty() ? firstField(mesh) : findField(mesh.fields, name);
    if (found == mesh.fields.size() && (name.empty() || isCoordinateName(name))) {
        TetMesh coordinates;
        coordinates.positions = mesh.positions;
        coordinates.cells = mesh.cells;
        addCoordinateField(coordinates, name);
        return {coordinates.fields.back().name, Association::Point, std::move(coordinates.fields.back().values)};
    }
    const Choice choice = chooseField(mesh, name);
    Field field = mesh.fields[choice.field];
    std::string title = fieldTitle(field, choice.component);
    const Association association = field.association;
    return {std::move(title), association, takeScalars(field, choice.component)};
}

ScalarSelection selectScalar(TetMesh&& mesh, const std::string& name, MeshReport& report) {
    const std::size_t found = name.empty() ? firstField(mesh) : findField(mesh.fields, name);
    if (found == mesh.fields.size() && (name.empty() || isCoordinateName(name))) {
        addCoordinateField(mesh, name);
    }
    const Choice choice = chooseField(mesh, name);
    Field& field = mesh.fields[choice.field];
    ScalarSelection selection;
    selection.fieldName = fieldTitle(field, choice.component);
    selection.mesh.association = field.association;
    selection.mesh.scalars = takeScalars(field, choice.component);
    selection.mesh.positions = std::move(mesh.positions);
    selection.mesh.cells = std::move(mesh.cells);
    mesh.fields.clear();
    if (selection.mesh.cells.empty()) {
        throw std::runtime_error("the mesh has no cell to show; give a mesh with at least one solid cell");
    }
    selection.nonFiniteCells = finishScalars(selection.mesh, report);
    if (selection.mesh.cells.empty()) {
        throw std::runtime_error(
            fmt::format("field '{}' is NaN, infinite or beyond 1e280 in every cell; choose another with --scalar",
                        selection.fieldName));
    }
    return selection;
}

std::uint64_t finishScalars(ScalarMesh& mesh, MeshReport& report) {
    const std::uint64_t dropped = dropNonFiniteCells(mesh, report);
    if (!mesh.cells.empty()) findRangeAndBounds(mesh, dropped == 0);
    return dropped;
}

}  // namespace tetralux::mesh
