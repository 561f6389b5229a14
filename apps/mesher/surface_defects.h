// SPDX-License-Identifier: Apache-2.0
/// \file
/// What can be wrong with a surface that is to enclose a volume, counted and located.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "geometry.h"

namespace tetralux::mesher {

enum class SurfaceDefect {
    NonFinitePoint,      ///< NaN or infinite coordinate
    DegenerateTriangle,  ///< two corners coincide or all three lie on a line
    DuplicateTriangle,   ///< the same three points once more
    NonManifoldEdge,     ///< more than two triangles meet at an edge
    InconsistentEdge,    ///< its two triangles run along it in the same direction: one of them is turned over
    Hole,                ///< a loop of edges that have one triangle only
    SelfIntersection,    ///< two triangles cut each other
    WrongSide,           ///< a shell faces inward that should face outward, or the other way round
};

/// One defect: how often, and the first place.
struct DefectFinding {
    SurfaceDefect defect;
    std::uint64_t count = 0;
    std::string where;  ///< "points 3 and 7 near (0, 1, 2)"
};

using SurfaceFindings = std::vector<DefectFinding>;

/// "2 holes (the largest: 12 edges, near (0, 1, 0)), 3 pairs of triangles cut each other (…)".
std::string describe(const SurfaceFindings& findings);

/// What would mend these findings, as the end of a sentence.
std::string remedy(const SurfaceFindings& findings);

/// Everything that can be told from points and triangles without asking which triangles meet in space. `findings` ends
/// with non-finite points where there are any: nothing else can then be told.
SurfaceFindings checkTopology(const TriangleSurface& surface);

/// Makes points one that coincide to the last bit; fields keep the value of the first. Returns how many went.
std::uint64_t mergeCoincidentPoints(TriangleSurface& surface);

/// Volume between the surface and the origin side of its triangles, by the divergence theorem; positive for a closed
/// surface that faces outward. Mesh units cubed.
double enclosedVolume(const TriangleSurface& surface);

/// How often the surface runs around `p`: 1 inside of an outward closed surface, 0 outside and in cavities
/// (Van Oosterom and Strackee 1983, Eq. 8, summed over the triangles).
double windingNumber(const TriangleSurface& surface, const glm::dvec3& p);

}  // namespace tetralux::mesher
