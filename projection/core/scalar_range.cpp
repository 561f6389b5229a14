// SPDX-License-Identifier: Apache-2.0
#include <projection/core/scalar_range.h>

#include <cmath>

namespace tetralux::projection {

namespace {

constexpr double leastRange = 1e-290;  // one over a smaller one, or over its square's root, leaves the range of double

}  // namespace

Scene withScalarsInRange(const Scene& scene) {
    const double range = scene.mesh->scalarMax - scene.mesh->scalarMin;
    if (!(range > 0) || range >= leastRange) return scene;
    const int exponent = -std::ilogb(range);
    auto scaled = [&](double& scalar) { scalar = std::ldexp(scalar, exponent); };
    auto mesh = std::make_shared<mesh::ScalarMesh>(*scene.mesh);
    for (double& scalar : mesh->scalars) scaled(scalar);
    scaled(mesh->scalarMin);
    scaled(mesh->scalarMax);
    Scene result = scene;
    result.mesh = std::move(mesh);
    preint::TransferFunction& function = result.transferFunction;
    for (auto& node : function.color) scaled(node.scalar);
    for (auto& node : function.extinction) {
        scaled(node.scalar);
        if (integralOf(scene.settings.mode) == preint::Integral::ScaleInvariant)
            node.extinction = std::ldexp(node.extinction, -exponent);
    }
    for (auto& surface : function.isosurfaces) scaled(surface.value);
    if (result.settings.adaptive && integralOf(scene.settings.mode) == preint::Integral::ScaleInvariant)
        scaled(result.settings.adaptive->pieceLength);
    return result;
}

}  // namespace tetralux::projection
