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

std::string listOfFields(const TetMesh& mesh) {
    std::string list;
    for (const Field& field : mesh.fields) {
        const char* where = field.association == Association::Point ? "points" : "cells";
        const std::string shape = field.components == 1 ? "" : fmt::format(", {} components", field.components);
        list += fmt::format("{}'{}' ({}{})", list.empty() ? "" : ", ", field.name, where, shape);
    }
    return list;
}

/// Position of the field called `name`, point fields first; fields.size() if there is none.
std::size_t findField(const std::vector<Field>& fields, const std::string& name) {
    for (const Association association : {Association::Point, Association::Cell}) {
        for (std::size_t i = 0; i < fields.size(); ++i) {
            if (fields[i].association == association && fields[i].name == name) {
                return i;
            }
        }
    }
    return fields.size();
}

/// The first point field, else the first cell field, that is not mere numbers of points or cells; fields.size() if
/// there is none.
std::size_t firstField(const std::vector<Field>& fields) {
    for (const Association association : {Association::Point, Association::Cell}) {
        const auto found = std::find_if(fields.begin(), fields.end(), [&](const Field& field) {
            return field.association == association && !field.bookkeeping;
        });
        if (found != fields.end()) {
            return static_cast<std::size_t>(found - fields.begin());
        }
    }
    return fields.size();
}

/// "0", "1", … or "x", "y", "z" as a component number; nothing that is no such name.
std::optional<int> parseComponent(const std::string& text) {
    if (text.size() == 1 && text[0] >= 'x' && text[0] <= 'z') {
        return text[0] - 'x';
    }
    int component = 0;
    const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), component);
    if (error != std::errc() || stop != text.data() + text.size() || component < 0) {
        return std::nullopt;
    }
    return component;
}

/// The whole of `name` is tried first, so that a field whose name has a colon can be chosen.
Choice chooseField(const TetMesh& mesh, const std::string& name) {
    if (name.empty()) {
        return {firstField(mesh.fields), magnitude};
    }
    if (const std::size_t whole = findField(mesh.fields, name); whole < mesh.fields.size()) {
        return {whole, magnitude};
    }
    if (const std::size_t colon = name.rfind(':'); colon != std::string::npos) {
        const std::size_t found = findField(mesh.fields, name.substr(0, colon));
        const std::optional<int> component = parseComponent(name.substr(colon + 1));
        if (found < mesh.fields.size()) {
            const Field& field = mesh.fields[found];
            if (component && *component < field.components) {
                return {found, *component};
            }
            throw std::runtime_error(fmt::format("field '{}' has no component '{}'; it has {} (0 to {})", field.name,
                                                 name.substr(colon + 1), field.components, field.components - 1));
        }
    }
    throw std::runtime_error(fmt::format("no field named '{}'; the mesh has {}", name, listOfFields(mesh)));
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
    return field.components <= 3 ? fmt::format("{} ({})", field.name, "xyz"[component])
                                 : fmt::format("{} ({})", field.name, component);
}

/// Scaling overflows just beyond `largestScalar` (not before 1.7e280).
double finiteIfDrawable(double value) {
    constexpr double scale = 1e28;
    return value * scale;
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

ScalarSelection selectScalar(TetMesh&& mesh, const std::string& name, MeshReport& report) {
    const std::size_t found = name.empty() ? firstField(mesh.fields) : findField(mesh.fields, name);
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
