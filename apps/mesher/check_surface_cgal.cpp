// SPDX-License-Identifier: Apache-2.0
// A program that links this file's object is under the GPL-3.0 (or later), as CGAL's polygon mesh processing is.
#include "check_surface_cgal.h"

#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <fmt/format.h>

#include <algorithm>

#include "surface_mesh_cgal.h"

namespace tetralux::mesher {
namespace {

namespace PMP = CGAL::Polygon_mesh_processing;

/// Whether triangles that share one point of the input meet anywhere else. (CGAL knows the point as two where the
/// surface pinches, so that it reports the pair.)
bool meetBeyondSharedPoint(const Soup& soup, const std::array<std::size_t, 3>& a, const std::array<std::size_t, 3>& b) {
    const auto oppositeSideMeets = [&](const auto& from, const auto& other) {
        std::vector<std::size_t> rest;
        for (const std::size_t i : from)
            if (std::find(other.begin(), other.end(), i) == other.end()) rest.push_back(i);
        if (rest.size() != 2) return false;  // they share an edge: counted as non-manifold already
        const Kernel::Segment_3 side(soup.points[rest[0]], soup.points[rest[1]]);
        const Kernel::Triangle_3 triangle(soup.points[other[0]], soup.points[other[1]], soup.points[other[2]]);
        return CGAL::do_intersect(side, triangle);
    };
    return oppositeSideMeets(a, b) || oppositeSideMeets(b, a);
}

void checkSelfIntersections(const Soup& soup, const SurfaceMesh& mesh, SurfaceFindings& findings) {
    std::vector<std::pair<SurfaceMesh::Face_index, SurfaceMesh::Face_index>> pairs;
    PMP::self_intersections(mesh, std::back_inserter(pairs));
    std::vector<std::pair<std::size_t, std::size_t>> real;
    for (const auto& [f, g] : pairs) {
        const auto &a = soup.triangles[f.idx()], &b = soup.triangles[g.idx()];
        const bool sharePoint =
            std::any_of(a.begin(), a.end(), [&](auto i) { return std::find(b.begin(), b.end(), i) != b.end(); });
        const bool neighbours = sharePoint && !meetBeyondSharedPoint(soup, a, b);
        if (!neighbours || f == g) real.emplace_back(std::minmax<std::size_t>(f.idx(), g.idx()));
    }
    if (real.empty()) return;
    std::sort(real.begin(), real.end());
    constexpr std::size_t shown = 3;
    std::string where = "triangles";
    for (std::size_t i = 0; i < std::min(shown, real.size()); ++i)
        where += fmt::format("{} {} and {}", i == 0 ? "" : ",", real[i].first, real[i].second);
    const auto& p = soup.points[soup.triangles[real[0].first][0]];
    where += fmt::format(" near ({:.6g}, {:.6g}, {:.6g})", p.x(), p.y(), p.z());
    findings.push_back({SurfaceDefect::SelfIntersection, real.size(), where});
}

/// A closed mesh without self-intersections: outer shells must face outward, cavities inward.
void checkSides(TriangleSurface& surface, SurfaceMesh& mesh, SurfaceFindings& findings, bool& turned) {
    if (PMP::does_bound_a_volume(
            mesh)) {  // also true where all faces inward: "the volume" is then all the rest of space
        turned = enclosedVolume(surface) < 0.0;
        if (turned)
            for (Triangle& t : surface.triangles) std::swap(t[1], t[2]);
        return;
    }
    SurfaceMesh right = mesh;
    PMP::orient_to_bound_a_volume(right);
    // Count shells whose orientation changed: one face of each tells.
    auto shells = right.add_property_map<SurfaceMesh::Face_index, std::size_t>("f:shell", 0).first;
    const std::size_t shellCount = PMP::connected_components(right, shells);
    std::vector<bool> seen(shellCount, false);
    for (const auto f : right.faces()) {
        if (seen[shells[f]]) continue;
        seen[shells[f]] = true;
        const auto h = mesh.halfedge(f);
        const auto matching = right.halfedge(mesh.source(h), mesh.target(h));
        const bool same = matching != SurfaceMesh::null_halfedge() && right.face(matching) == f;
        if (same) continue;
        const auto& p = right.point(right.target(right.halfedge(f)));
        const std::string where =
            fmt::format("at triangle {} near ({:.6g}, {:.6g}, {:.6g})", f.idx(), p.x(), p.y(), p.z());
        if (!findings.empty() && findings.back().defect == SurfaceDefect::WrongSide)
            ++findings.back().count;
        else
            findings.push_back({SurfaceDefect::WrongSide, 1, where});
    }
}

}  // namespace

SurfaceFindings checkSurface(TriangleSurface& surface, bool& turned) {
    turned = false;
    SurfaceFindings findings = checkTopology(surface);
    const auto has = [&](SurfaceDefect defect) {
        return std::any_of(findings.begin(), findings.end(), [&](const auto& f) { return f.defect == defect; });
    };
    if (has(SurfaceDefect::NonFinitePoint) || has(SurfaceDefect::DegenerateTriangle)) return findings;
    const Soup soup = soupOf(surface);
    SurfaceMesh mesh = meshOf(soup);
    checkSelfIntersections(soup, mesh, findings);
    if (findings.empty()) checkSides(surface, mesh, findings, turned);
    return findings;
}

}  // namespace tetralux::mesher
