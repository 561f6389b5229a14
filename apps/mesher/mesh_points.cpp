// SPDX-License-Identifier: Apache-2.0
#include "mesh_points.h"

#include <fmt/format.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "surface_defects.h"
#include "tet_assembly.h"
#ifdef TETRALUX_CGAL
#include "delaunay_cgal.h"
#endif
#ifdef TETRALUX_TETGEN
#include "tetrahedralize_tetgen.h"
#endif

namespace tetralux::mesher {
namespace {

/// Whether all points lie within rounding of one plane (TetGen ends the program then): the two points farthest along
/// make a line, the farthest from it a plane, and the farthest from that a height.
bool coplanar(const std::vector<glm::dvec3>& points) {
    const auto farthest = [&](const auto& measure) {
        std::size_t best = 0;
        double most = -1.0;
        for (std::size_t i = 0; i < points.size(); ++i)
            if (const double m = measure(points[i]); m > most) {
                most = m;
                best = i;
            }
        return points[best];
    };
    const glm::dvec3 a = points[0];
    const glm::dvec3 b = farthest([&](const glm::dvec3& p) { return glm::length(p - a); });
    const glm::dvec3 c = farthest([&](const glm::dvec3& p) { return glm::length(glm::cross(b - a, p - a)); });
    const glm::dvec3 normal = glm::cross(b - a, c - a);
    const double size = glm::length(b - a);
    if (!(glm::length(normal) > 1e-14 * size * size)) return true;
    const glm::dvec3 unit = normal / glm::length(normal);
    const glm::dvec3 d = farthest([&](const glm::dvec3& p) { return std::abs(glm::dot(p - a, unit)); });
    return std::abs(glm::dot(d - a, unit)) <= 1e-14 * size;
}

void check(const std::vector<glm::dvec3>& points) {
    if (points.size() < 4)
        throw std::runtime_error(fmt::format("{} different points: a tetrahedron needs four", points.size()));
    for (std::size_t i = 0; i < points.size(); ++i)
        if (!std::isfinite(points[i].x) || !std::isfinite(points[i].y) || !std::isfinite(points[i].z))
            throw std::runtime_error(fmt::format("point {} has a NaN or infinite coordinate: remove it", i));
    if (coplanar(points))
        throw std::runtime_error("all points lie in one plane and enclose no volume: add points off it");
}

RawTetrahedra delaunay(const std::vector<glm::dvec3>& points, const Options& options,
                       [[maybe_unused]] const Deadline& deadline) {
#ifdef TETRALUX_CGAL
    if (options.method == "cgal") return delaunayByCgal(points);
#endif
#ifdef TETRALUX_TETGEN
    if (options.method == "tetgen") return delaunayByTetGen(points, deadline);
#endif
    (void)points;
    throw std::runtime_error(
        fmt::format("this tetralux-mesher was built without --method {}: take the other one", options.method));
}

}  // namespace

mesh::TetMesh meshPoints(PolygonSoup&& cloud, const Options& options, const Deadline& deadline,
                         const Listener& listener, nlohmann::json& report) {
    TriangleSurface points{std::move(cloud.points), {}, std::move(cloud.fields)};
    const std::uint64_t merged = mergeCoincidentPoints(points);
    check(points.points);
    listener.stage("Delaunay tetrahedra");
    Assembly assembly = assemble(delaunay(points.points, options, deadline));
    if (assembly.mesh.cells.empty())
        throw std::runtime_error("all points lie almost in one plane and enclose no volume: add points off it");
    listener.note(fmt::format("{} points, {} coinciding ones left out, {} flat cells left out ({})",
                              points.points.size(), merged, assembly.flatCells, options.method));
    for (const mesh::Field& field : points.fields) {
        mesh::Field taken{field.name, field.association, field.components, {}};
        const auto n = static_cast<std::size_t>(field.components);
        for (const std::uint32_t i : assembly.source)
            for (std::size_t k = 0; k < n; ++k) taken.values.push_back(field.values[i * n + k]);
        assembly.mesh.fields.push_back(std::move(taken));
    }
    report["cloud"] = {{"points", points.points.size()},
                       {"coinciding", merged},
                       {"flat_cells", assembly.flatCells},
                       {"method", options.method}};
    return std::move(assembly.mesh);
}

}  // namespace tetralux::mesher
