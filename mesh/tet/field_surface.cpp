// SPDX-License-Identifier: Apache-2.0
#include <mesh/tet/field_surface.h>

#include <algorithm>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace tetralux::mesh {

namespace {

std::vector<double> valuesOfCells(const Field& field, const std::vector<CellIndex>& cells) {
    const auto width = static_cast<std::size_t>(field.components);
    std::vector<double> values;
    values.reserve(cells.size() * width);
    for (const CellIndex cell : cells)
        for (std::size_t c = 0; c < width; ++c) values.push_back(field.values[cell * width + c]);
    return values;
}

/// Edges that are not run through as often one way as the other.
std::uint64_t countOpenEdges(const std::vector<std::array<PointIndex, 3>>& triangles) {
    struct Edge {
        std::uint64_t key;
        int way;
    };
    std::vector<Edge> edges;
    edges.reserve(3 * triangles.size());
    for (const auto& triangle : triangles)
        for (std::size_t k = 0; k < 3; ++k) {
            const PointIndex a = triangle[k], b = triangle[(k + 1) % 3];
            edges.push_back({std::uint64_t{std::min(a, b)} << 32 | std::max(a, b), a < b ? 1 : -1});
        }
    std::sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) { return a.key < b.key; });
    std::uint64_t open = 0;
    for (std::size_t i = 0; i < edges.size();) {
        const std::uint64_t key = edges[i].key;
        int sum = 0;
        for (; i < edges.size() && edges[i].key == key; ++i) sum += edges[i].way;
        open += sum != 0 ? 1 : 0;
    }
    return open;
}

}  // namespace

FieldSurface surfaceOf(const TetMesh& mesh, const MeshCut& cut) {
    FieldSurface surface{cutPositions(cut, mesh.positions), cut.triangles, {}};
    for (const Field& field : mesh.fields) {
        Field carried = field;
        carried.values = field.association == Association::Point ? cutValues(cut, field.values, field.components)
                                                                 : valuesOfCells(field, cut.cells);
        surface.fields.push_back(std::move(carried));
    }
    return surface;
}

SurfaceMeasure measure(const FieldSurface& surface) {
    SurfaceMeasure result;
    result.openEdges = countOpenEdges(surface.triangles);
    if (surface.positions.empty()) return result;
    glm::dvec3 low = surface.positions.front(), high = low;
    for (const glm::dvec3& p : surface.positions) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    const glm::dvec3 middle = 0.5 * low + 0.5 * high;  // near the surface, so that large coordinates do not cancel
    for (const auto& [i, j, k] : surface.triangles) {
        const glm::dvec3 a = surface.positions[i] - middle, b = surface.positions[j] - middle,
                         c = surface.positions[k] - middle;
        result.area += 0.5 * glm::length(glm::cross(b - a, c - a));
        result.volume += glm::dot(a, glm::cross(b, c)) / 6.0;
    }
    return result;
}

}  // namespace tetralux::mesh
