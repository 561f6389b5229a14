// SPDX-License-Identifier: Apache-2.0
/// \file
/// Between our triangles and CGAL's; for the two files behind check_surface_cgal.h alone.
#pragma once

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Surface_mesh.h>

#include <array>
#include <vector>

#include "geometry.h"

namespace tetralux::mesher {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using SurfaceMesh = CGAL::Surface_mesh<Kernel::Point_3>;

struct Soup {
    std::vector<Kernel::Point_3> points;
    std::vector<std::array<std::size_t, 3>> triangles;
};

inline Soup soupOf(const TriangleSurface& surface) {
    Soup soup;
    soup.points.reserve(surface.points.size());
    for (const glm::dvec3& p : surface.points) soup.points.emplace_back(p.x, p.y, p.z);
    soup.triangles.reserve(surface.triangles.size());
    for (const Triangle& t : surface.triangles) soup.triangles.push_back({t[0], t[1], t[2]});
    return soup;
}

/// Points and edges that are not manifold are made double, triangles turned where that makes neighbours agree: face i
/// is triangle i.
inline SurfaceMesh meshOf(Soup soup) {
    namespace PMP = CGAL::Polygon_mesh_processing;
    PMP::orient_polygon_soup(soup.points, soup.triangles);
    SurfaceMesh mesh;
    PMP::polygon_soup_to_polygon_mesh(soup.points, soup.triangles, mesh);
    return mesh;
}

}  // namespace tetralux::mesher
