// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <mesh/tet/tet_mesh.h>

namespace tetralux::mesh {

/// The gradient of the scalar that is linear in a cell: unit direction, and magnitude in scalar units per mesh unit.
/// Whatever the magnitude of lengths and scalars: no square of theirs is taken.
struct CellSlope {
    glm::dvec3 normal;
    double magnitude;

    /// Whether there is a gradient: not where all corners have the same value, nor for cell data; then both numbers
    /// are 0. Values that agree but for rounding do have one: which differences are rounding is not for us to say, and
    /// differences of numbers that nearly agree are exact.
    bool any() const { return magnitude > 0; }
};
CellSlope cellSlope(const ScalarMesh& mesh, CellIndex cell);

}  // namespace tetralux::mesh
