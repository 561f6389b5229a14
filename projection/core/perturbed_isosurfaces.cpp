// SPDX-License-Identifier: Apache-2.0
#include <projection/core/perturbed_isosurfaces.h>

#include <algorithm>
#include <cmath>

namespace tetralux::projection {

namespace {

/// Whether two neighbouring nodes stand at `value`.
template <class Nodes>
bool jumpsAt(const Nodes& nodes, double value) {
    return std::count_if(nodes.begin(), nodes.end(), [&](const auto& node) { return node.scalar == value; }) > 1;
}

}  // namespace

Scene withPerturbedIsosurfaces(const Scene& scene, double share) {
    Scene result = scene;
    const mesh::ScalarMesh& mesh = *scene.mesh;
    constexpr double steps = 4.0;  // of double at the scalars themselves, where the range is small beside them
    const double largest = std::max(std::abs(mesh.scalarMin), std::abs(mesh.scalarMax));
    const double step = std::max(share * (mesh.scalarMax - mesh.scalarMin), steps * 0x1p-53 * largest);
    const preint::TransferFunction& function = scene.transferFunction;
    for (preint::Isosurface& surface : result.transferFunction.isosurfaces)
        if (!jumpsAt(function.color, surface.value) && !jumpsAt(function.extinction, surface.value))
            surface.value -= step;
    return result;
}

}  // namespace tetralux::projection
