// SPDX-License-Identifier: Apache-2.0
/// \file
/// The part as a surface: the faces that bound a mesh, and where clipping planes cut it.
#pragma once

#include <optional>
#include <vector>

#include <glm/vec3.hpp>

#include <mesh/tet/tet_mesh.h>
#include <projection/core/clip_region.h>
#include <projection/opaque/opaque_objects.h>

namespace tetralux::projection {

struct BoundaryLook {
    double opacity = 1.0;
    std::optional<glm::dvec3> color{};  ///< display RGB; not given: the transfer function's of the field
    bool flat = false;                  ///< without light
    double featureAngle = 30.0;         ///< degrees: edges that are bent by less look round
    std::optional<SurfaceEdges> edges{};
};

/// The faces of the mesh without a cell behind them, seen counter-clockwise from outside, with the mesh's scalar, and,
/// for each of `clips`, what of the mesh lies in its plane; all of it clipped by them.
std::vector<OpaqueSurface> boundarySurfaces(const mesh::ScalarMesh& mesh, const std::vector<HalfSpace>& clips,
                                            const BoundaryLook& look);

}  // namespace tetralux::projection
