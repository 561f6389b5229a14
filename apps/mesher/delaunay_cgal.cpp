// SPDX-License-Identifier: Apache-2.0
// A program that links this file's object is under the GPL-3.0 (or later), as CGAL's Triangulation_3 is.
#include "delaunay_cgal.h"

#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_data_structure_3.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>

#include <stdexcept>
#include <utility>

namespace tetralux::mesher {

RawTetrahedra delaunayByCgal(const std::vector<glm::dvec3>& points) {
    using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
    using Vertex = CGAL::Triangulation_vertex_base_with_info_3<std::uint32_t, Kernel>;
    // Sequential: with CGAL's Parallel_tag a million points took longer on two cores than without.
    using Delaunay = CGAL::Delaunay_triangulation_3<
        Kernel, CGAL::Triangulation_data_structure_3<Vertex, CGAL::Delaunay_triangulation_cell_base_3<Kernel>>>;
    std::vector<std::pair<Kernel::Point_3, std::uint32_t>> numbered;
    numbered.reserve(points.size());
    for (std::uint32_t i = 0; i < points.size(); ++i)
        numbered.emplace_back(Kernel::Point_3(points[i].x, points[i].y, points[i].z), i);
    const Delaunay delaunay(numbered.begin(), numbered.end());
    if (delaunay.dimension() < 3) throw std::runtime_error("all points lie in one plane: they enclose no volume");
    RawTetrahedra result;
    result.points = points;
    result.cells.reserve(delaunay.number_of_finite_cells());
    for (const auto& cell : delaunay.finite_cell_handles())
        result.cells.push_back(
            {cell->vertex(0)->info(), cell->vertex(1)->info(), cell->vertex(2)->info(), cell->vertex(3)->info()});
    return result;
}

}  // namespace tetralux::mesher
