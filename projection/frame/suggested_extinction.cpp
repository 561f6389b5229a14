// SPDX-License-Identifier: Apache-2.0
#include <projection/frame/suggested_extinction.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <mesh/tet/volume_samples.h>

namespace tetralux::projection {

namespace {

/// Mean length of a line's way through the box (four times volume over surface), scaled so that a cube has its
/// diagonal.
double thickness(const mesh::BoundingBox& box) {
    const glm::dvec3 size = box.high - box.low;
    const double longest = std::max({size.x, size.y, size.z});
    const glm::dvec3 part = size / longest;
    const double surface = part.x * part.y + part.y * part.z + part.z * part.x;
    return surface > 0.0 ? 3.0 * std::numbers::sqrt3 * longest * part.x * part.y * part.z / surface : box.diagonal();
}

preint::TransferFunction resolvedWith(double extent, const preint::TransferFunction& function,
                                      const mesh::ScalarMesh& mesh, const FunctionUse& use) {
    return use.window ? preint::windowed(function, use.window->x, use.window->y, extent)
                      : preint::resolved(function, mesh.scalarMin, mesh.scalarMax, extent);
}

/// With the extinction that shows this very mesh: where it is thin, or where most of it has low values, more than its
/// box tells. Never less than the function's own along the mean way through a cube.
preint::TransferFunction suggestedFor(const preint::TransferFunction& function, const mesh::ScalarMesh& mesh,
                                      const FunctionUse& use) {
    constexpr double wantedOpacity = 0.6;  // of the mean way, if it had one value, on average over the volume
    constexpr double mostAdded = 8.0;
    const mesh::VolumeSamples samples = mesh::sampleVolume(mesh);
    if (samples.scalars.empty() || !(samples.meanWay > 0.0))
        return resolvedWith(thickness(mesh.bounds), function, mesh, use);
    const double extent = std::numbers::sqrt3 * samples.meanWay;
    const preint::TransferFunction plain = resolvedWith(extent, function, mesh, use);
    std::vector<double> depths;
    for (const double scalar : samples.scalars) depths.push_back(samples.meanWay * plain.extinctionAt(scalar));
    const auto opacity = [&](double factor) {
        double sum = 0.0;
        for (const double depth : depths) sum -= std::expm1(-factor * depth);
        return sum / static_cast<double>(depths.size());
    };
    double low = 1.0, high = mostAdded;
    for (int halving = 0; halving < 10 && opacity(low) < wantedOpacity; ++halving) {
        const double middle = std::sqrt(low * high);
        (opacity(middle) < wantedOpacity ? low : high) = middle;
    }
    return resolvedWith(extent / low, function, mesh, use);
}

}  // namespace

preint::TransferFunction defaultTransferFunction() {
    preint::TransferFunction function = preint::preset("cool-to-warm");
    function.extinction = {{0.0, 0.5}, {0.15, 0.8}, {0.5, 4.0}, {1.0, 25.0}};
    return function;
}

glm::dvec2 shownRange(const FunctionUse& use, const mesh::ScalarMesh& mesh) {
    if (use.window && use.window->x < use.window->y) return *use.window;
    return {mesh.scalarMin, mesh.scalarMax};
}

preint::TransferFunction resolvedFor(const preint::TransferFunction& function, const mesh::ScalarMesh& mesh,
                                     const FunctionUse& use) {
    if (use.perScalar || integralOf(use.mode) == preint::Integral::ScaleInvariant) {
        const glm::dvec2 range = shownRange(use, mesh);
        return resolvedWith(range.y - range.x, function, mesh, use);
    }
    return use.suggested ? suggestedFor(function, mesh, use)
                         : resolvedWith(thickness(mesh.bounds), function, mesh, use);
}

}  // namespace tetralux::projection
