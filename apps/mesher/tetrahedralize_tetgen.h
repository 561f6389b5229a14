// SPDX-License-Identifier: Apache-2.0
/// \file
/// The one door to TetGen (Si, "TetGen, a Delaunay-based quality tetrahedral mesh generator", ACM TOMS 41(2), 2015).
///
/// TetGen 1.5.0 ends the program on bad input in every way there is (a signal, an assert, an exception that cannot be
/// caught, silence), so it runs in a child process, and each of these becomes an exception with one line of text.
#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "child_process.h"
#include "geometry.h"

namespace tetralux::mesher {

struct TetGenOptions {
    double quality = 0.0;    ///< largest circumradius to shortest edge ratio of a tetrahedron (at least 1); 0: no bound
    double maxVolume = 0.0;  ///< of a tetrahedron, mesh units cubed; 0: no bound
    bool keepSurface = false;  ///< no point is added on the surface
    double coplanarity =
        1e-8;  ///< TetGen's -T: facets this close to one plane are treated as one; a part of their size
};

/// The inside of a closed surface, cavities filled (their cells bear a region of their own). Input points come first
/// and unmoved. \throws std::runtime_error saying what TetGen did.
RawTetrahedra tetrahedralizeSurface(const TriangleSurface& surface, const TetGenOptions& options,
                                    const Deadline& deadline);

/// Delaunay tetrahedra of the points' convex hull. \throws std::runtime_error saying what TetGen did.
RawTetrahedra delaunayByTetGen(const std::vector<glm::dvec3>& points, const Deadline& deadline);

}  // namespace tetralux::mesher
