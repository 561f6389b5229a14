// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include <mesh/tet/surface_mesh.h>

namespace tetralux::mesh {

/// A straight piece of an isoline.
struct IsolineSegment {
    glm::dvec3 from, to;
    std::uint32_t value;  ///< which of the values
};

/// Where the scalar of a surface crosses `values` (ascending), exactly: by point data within the triangles, by cell
/// data along the edges between them. a to b crosses v when (a < v) ≠ (b < v).
std::vector<IsolineSegment> isolines(const SurfaceMesh& surface, const std::vector<double>& values);

}  // namespace tetralux::mesh
