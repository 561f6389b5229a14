// SPDX-License-Identifier: Apache-2.0
/// \file
/// Units in which fast engines compute, so that float holds meshes and scalars of any magnitude.
#pragma once

#include <mesh/tet/tet_mesh.h>
#include <preint/exact_integral.h>
#include <preint/transfer_function.h>

namespace tetralux::projection {

/// Scalars become (s − scalarOffset)/scalarScale in [0, 1], lengths are divided by `length` (the mesh's diagonal).
struct SceneUnits {
    double scalarOffset = 0.0, scalarScale = 1.0, length = 1.0;
    double toUnit(double scalar) const { return (scalar - scalarOffset) / scalarScale; }
};
SceneUnits sceneUnits(const mesh::ScalarMesh& mesh);

/// The transfer function in scene units: extinction per scene length (standard) or per unit scalar (scale-invariant).
preint::TransferFunction inSceneUnits(const preint::TransferFunction& function, const SceneUnits& units,
                                      preint::Integral integral);

}  // namespace tetralux::projection
