// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include <glm/vec3.hpp>

#include <mesh/tet/surface_mesh.h>

namespace tetralux::projection {

/// The plane through `point`; within the mesh it shows the transfer function's colour at the scalar there.
struct Slice {
    glm::dvec3 point, normal;  ///< mesh units; normal of any length but 0
    double opacity = 1.0;      ///< below 1 what lies behind shows too (translucent_slices.h)
};

/// Lines on slices where the scalar has these values.
struct Isolines {
    std::vector<double> values;       ///< ascending
    double width = 1.5;               ///< pixels
    std::optional<glm::dvec3> color;  ///< display RGB; not given: black or white, whichever stands out from the slice
};

/// Lines along the edges of a surface's triangles.
struct SurfaceEdges {
    double width = 1.0;  ///< pixels
    glm::dvec3 color{0.1, 0.1, 0.1};
};

/// A surface, each triangle lit by itself from the side that the eye sees (colour as it is where `flat`).
struct OpaqueSurface {
    std::shared_ptr<const mesh::SurfaceMesh> mesh;
    glm::dvec3 color{0.8, 0.8, 0.8};
    bool flat = false;
    bool byField = false;  ///< in the transfer function's colours of its scalars, which it must have, instead
    double opacity = 1.0;  ///< below 1 what lies behind shows too (translucent_slices.h)
    /// Normals are interpolated across edges that are bent by less, degrees; not given: 40 where the scene's normals
    /// are smooth, else each triangle has its own.
    std::optional<double> featureAngle{};
    std::optional<SurfaceEdges> edges{};
    bool clipped = false;  ///< clipping planes leave out parts of it, as of slices

    /// What is clear or cut keeps no light from the volume, nor does the volume's own boundary.
    bool castsShadows() const { return opacity == 1.0 && !clipped; }
};

/// What stands in the volume besides it.
struct OpaqueObjects {
    std::vector<Slice> slices;
    std::vector<OpaqueSurface> surfaces;
    Isolines isolines{};  ///< on all slices, opaque however clear those are
    bool empty() const { return slices.empty() && surfaces.empty(); }
};

}  // namespace tetralux::projection
