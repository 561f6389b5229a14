// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <mesh/tet/tet_mesh.h>

#include "geometry.h"
#include "pipeline.h"

namespace tetralux::mesher {

/// Checks (and with --repair mends) a surface, fills it with tetrahedra and carries its values over. Cavities (shells
/// that face inward within another) stay empty. The cells' volume is held against the surface's to 1e-6. \throws
/// std::runtime_error, without the input's name, that names the defect and what would mend it.
mesh::TetMesh meshSurface(TriangleSurface&& surface, const Options& options, const Deadline& deadline,
                          const Listener& listener, nlohmann::json& report);

}  // namespace tetralux::mesher
