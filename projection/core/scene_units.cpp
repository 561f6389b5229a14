// SPDX-License-Identifier: Apache-2.0
#include <projection/core/scene_units.h>

namespace tetralux::projection {

SceneUnits sceneUnits(const mesh::ScalarMesh& mesh) {
    SceneUnits units;
    units.scalarOffset = mesh.scalarMin;
    double range = mesh.scalarMax - mesh.scalarMin;
    units.scalarScale = range > 0 ? range : 1.0;
    double diagonal = mesh.bounds.diagonal();
    units.length = diagonal > 0 ? diagonal : 1.0;
    return units;
}

preint::TransferFunction inSceneUnits(const preint::TransferFunction& function, const SceneUnits& units,
                                      preint::Integral integral) {
    preint::TransferFunction result = function;
    double extinctionScale = integral == preint::Integral::Standard ? units.length : units.scalarScale;
    for (auto& node : result.color) node.scalar = units.toUnit(node.scalar);
    for (auto& node : result.extinction) {
        node.scalar = units.toUnit(node.scalar);
        node.extinction *= extinctionScale;
    }
    for (auto& surface : result.isosurfaces) surface.value = units.toUnit(surface.value);
    return result;
}

}  // namespace tetralux::projection
