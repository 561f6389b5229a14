// SPDX-License-Identifier: Apache-2.0
#include <projection/frame/function_advice.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include <mesh/tet/volume_samples.h>

namespace tetralux::projection {

namespace {

/// Scalars of the first and the last node.
glm::dvec2 nodeRange(const preint::TransferFunction& function) {
    glm::dvec2 range(std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity());
    const auto include = [&](double scalar) { range = {std::min(range.x, scalar), std::max(range.y, scalar)}; };
    for (const preint::ColorNode& node : function.color) include(node.scalar);
    for (const preint::ExtinctionNode& node : function.extinction) include(node.scalar);
    for (const preint::Isosurface& surface : function.isosurfaces) include(surface.value);
    return range;
}

}  // namespace

std::string functionAdvice(const Scene& scene) {
    const preint::TransferFunction& function = scene.transferFunction;
    const double low = scene.mesh->scalarMin, high = scene.mesh->scalarMax;
    const glm::dvec2 nodes = nodeRange(function);
    if (nodes.x < nodes.y && (nodes.y < low || nodes.x > high))
        return fmt::format(
            "the transfer function's nodes, {:.6g} to {:.6g}, all lie {} the field's scalars, {:.6g} to {:.6g}; give "
            "--range, "
            "or a function of these",
            nodes.x, nodes.y, nodes.y < low ? "below" : "above", low, high);
    const Mode mode = scene.settings.mode;
    if ((mode != Mode::Standard && mode != Mode::Absorption) || !function.isosurfaces.empty() ||
        scene.settings.adaptive || scene.settings.shading.silhouette)
        return "";
    double densest = 0.0;
    const mesh::VolumeSamples samples = mesh::sampleVolume(*scene.mesh);
    for (const double scalar : samples.scalars) densest = std::max(densest, function.extinctionAt(scalar));
    constexpr double leastShown = 1.0 / 255.0;
    const double opacity = -std::expm1(-densest * scene.mesh->bounds.diagonal());
    if (!(densest > 0.0) || opacity >= leastShown) return "";
    return fmt::format(
        "next to nothing shows: the largest extinction, {:.3g}, is an opacity of {:.2g} over the mesh's whole "
        "diagonal; raise it, for instance with --opacity {:.0g}",
        densest, opacity, 1.0 / (densest * scene.mesh->bounds.diagonal()));
}

}  // namespace tetralux::projection
