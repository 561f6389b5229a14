// SPDX-License-Identifier: Apache-2.0
// A program that links this file's object is under the GPL-3.0 (or later), as CGAL's polygon mesh processing is.
#include <CGAL/Polygon_mesh_processing/border.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Polygon_mesh_processing/repair_degeneracies.h>
#include <CGAL/Polygon_mesh_processing/repair_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/repair_self_intersections.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Polygon_mesh_processing/stitch_borders.h>
#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "check_surface_cgal.h"
#include "surface_mesh_cgal.h"

namespace tetralux::mesher {
namespace {

namespace PMP = CGAL::Polygon_mesh_processing;

void say(std::vector<std::string>& done, std::size_t count, const char* one, const char* many) {
    if (count > 0) done.push_back(fmt::format("{} {}", count, count == 1 ? one : many));
}

void dropNonFinite(Soup& soup, std::vector<std::string>& done) {
    const std::size_t dropped = std::erase_if(soup.triangles, [&](const auto& t) {
        return std::any_of(t.begin(), t.end(), [&](std::size_t i) {
            const auto& p = soup.points[i];
            return !std::isfinite(p.x()) || !std::isfinite(p.y()) || !std::isfinite(p.z());
        });
    });
    for (auto& p : soup.points)  // no triangle uses them now, but they would upset sorting
        if (!std::isfinite(p.x()) || !std::isfinite(p.y()) || !std::isfinite(p.z())) p = Kernel::Point_3(0, 0, 0);
    say(done, dropped, "triangle with NaN or infinite coordinates dropped",
        "triangles with NaN or infinite coordinates dropped");
}

void mergePoints(Soup& soup, std::vector<std::string>& done) {
    PMP::remove_isolated_points_in_polygon_soup(soup.points, soup.triangles);
    say(done, PMP::merge_duplicate_points_in_polygon_soup(soup.points, soup.triangles), "coincident point merged",
        "coincident points merged");
    // Not repair_polygon_soup, which wants to shorten polygons: ours have three corners by type.
    const std::size_t before = soup.triangles.size();
    std::erase_if(soup.triangles, [](const auto& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; });
    PMP::merge_duplicate_polygons_in_polygon_soup(soup.points, soup.triangles);
    PMP::remove_isolated_points_in_polygon_soup(soup.points, soup.triangles);
    say(done, before - soup.triangles.size(), "collapsed or double triangle dropped",
        "collapsed or double triangles dropped");
}

void fillHoles(SurfaceMesh& mesh, std::vector<std::string>& done) {
    std::vector<SurfaceMesh::Halfedge_index> holes;
    PMP::extract_boundary_cycles(mesh, std::back_inserter(holes));
    std::size_t filled = 0, added = 0;
    for (const auto hole : holes) {
        std::vector<SurfaceMesh::Face_index> faces;
        PMP::triangulate_hole(mesh, hole, std::back_inserter(faces));
        filled += faces.empty() ? 0 : 1;
        added += faces.size();
    }
    if (filled > 0)
        done.push_back(fmt::format("{} filled with {} triangles",
                                   filled == 1 ? "1 hole" : fmt::format("{} holes", filled), added));
}

void removeSelfIntersections(SurfaceMesh& mesh, std::vector<std::string>& done) {
    std::vector<std::pair<SurfaceMesh::Face_index, SurfaceMesh::Face_index>> pairs;
    PMP::self_intersections(mesh, std::back_inserter(pairs));
    if (pairs.empty()) return;
    const std::size_t before = pairs.size();
    PMP::experimental::remove_self_intersections(mesh, CGAL::parameters::preserve_genus(false));
    mesh.collect_garbage();
    pairs.clear();
    PMP::self_intersections(mesh, std::back_inserter(pairs));
    say(done, before - std::min(before, pairs.size()), "self-intersection removed (the surface there is new)",
        "self-intersections removed (the surface there is new)");
}

TriangleSurface surfaceOf(const SurfaceMesh& mesh) {
    TriangleSurface surface;
    std::vector<std::uint32_t> index(mesh.num_vertices() + mesh.number_of_removed_vertices(), 0);
    for (const auto v : mesh.vertices()) {
        index[v.idx()] = static_cast<std::uint32_t>(surface.points.size());
        const auto& p = mesh.point(v);
        surface.points.emplace_back(p.x(), p.y(), p.z());
    }
    for (const auto f : mesh.faces()) {
        Triangle t{};
        std::size_t k = 0;
        for (const auto v : mesh.vertices_around_face(mesh.halfedge(f)))
            if (k < 3) t[k++] = index[v.idx()];
        surface.triangles.push_back(t);
    }
    return surface;
}

}  // namespace

TriangleSurface repairSurface(const TriangleSurface& surface, std::vector<std::string>& done) {
    Soup soup = soupOf(surface);
    dropNonFinite(soup, done);
    mergePoints(soup, done);
    if (soup.triangles.empty()) return {};
    if (!PMP::orient_polygon_soup(soup.points, soup.triangles))
        done.push_back("points made double where more than two triangles meet at an edge");
    SurfaceMesh mesh;
    PMP::polygon_soup_to_polygon_mesh(soup.points, soup.triangles, mesh);
    say(done, PMP::stitch_borders(mesh), "pair of border edges stitched", "pairs of border edges stitched");
    if (!PMP::remove_degenerate_faces(mesh)) done.push_back("some degenerate triangles could not be removed");
    fillHoles(mesh, done);
    removeSelfIntersections(mesh, done);
    fillHoles(mesh, done);  // which removing may have left
    if (CGAL::is_closed(mesh) && (!PMP::does_bound_a_volume(mesh) || PMP::volume(mesh) < 0.0)) {
        PMP::orient_to_bound_a_volume(mesh);
        done.push_back("shells turned to the right side");
    }
    mesh.collect_garbage();
    return surfaceOf(mesh);
}

}  // namespace tetralux::mesher
