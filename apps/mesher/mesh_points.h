// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <mesh/tet/tet_mesh.h>

#include "geometry.h"
#include "pipeline.h"

namespace tetralux::mesher {

/// The Delaunay tetrahedra of a cloud's points, each with its values (of coinciding points, those of the first).
/// \throws std::runtime_error, without the input's name, when the points are too few, not finite, or lie in one plane.
mesh::TetMesh meshPoints(PolygonSoup&& cloud, const Options& options, const Deadline& deadline,
                         const Listener& listener, nlohmann::json& report);

}  // namespace tetralux::mesher
