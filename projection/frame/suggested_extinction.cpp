// SPDX-License-Identifier: Apache-2.0
#include <projection/frame/suggested_extinction.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <vector>

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

/// What `function` is fitted to where extinction per extent means `extent`.
preint::FitTo fit(double extent, double diagonal, const preint::TransferFunction& function,
                  const mesh::ScalarMesh& mesh) {
    return {mesh.scalarMin, mesh.scalarMax, extent, diagonal,
            function.categories.empty() ? std::vector<double>{} : fewValues(mesh)};
}

/// With the extinction that shows this very mesh: where it is thin, or where most of it has low values, more than its
/// box tells. Never less than the function's own along the mean way through a cube.
preint::TransferFunction suggestedFor(const preint::TransferFunction& function, const mesh::ScalarMesh& mesh,
                                      const mesh::VolumeSamples& samples) {
    constexpr double wantedOpacity = 0.6;  // of the mean way, if it had one value, on average over the volume
    constexpr double mostAdded = 8.0;
    const double diagonal = mesh.bounds.diagonal();
    if (samples.scalars.empty() || !(samples.meanWay > 0.0))
        return preint::resolved(function, fit(thickness(mesh.bounds), diagonal, function, mesh));
    preint::FitTo to = fit(std::numbers::sqrt3 * samples.meanWay, diagonal, function, mesh);
    preint::TransferFunction unscaled = function;
    unscaled.opacityScale = 1.0;  // what is asked for on top of the suggestion is no part of it
    const preint::TransferFunction plain = preint::resolved(unscaled, to);
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
    to.extent /= low;
    return preint::resolved(function, to);
}

}  // namespace

preint::TransferFunction defaultTransferFunction() {
    return preint::preset("cool-to-warm");
}

glm::dvec2 shownRange(const preint::TransferFunction& function, const mesh::ScalarMesh& mesh) {
    if (function.range && function.range->x < function.range->y) return *function.range;
    return {mesh.scalarMin, mesh.scalarMax};
}

std::vector<double> fewValues(const mesh::ScalarMesh& mesh) {
    constexpr std::size_t most = 256;
    std::set<double> values;
    for (const double scalar : mesh.scalars) {
        values.insert(scalar);
        if (values.size() > most) return {};
    }
    return {values.begin(), values.end()};
}

preint::TransferFunction resolvedFor(const preint::TransferFunction& function, const mesh::ScalarMesh& mesh,
                                     const FunctionUse& use) {
    if (use.perScalar || integralOf(use.mode) == preint::Integral::ScaleInvariant) {
        const glm::dvec2 range = shownRange(function, mesh);
        return preint::resolved(function, fit(range.y - range.x, range.y - range.x, function, mesh));
    }
    if (!function.extinctionSuggested)
        return preint::resolved(function, fit(thickness(mesh.bounds), mesh.bounds.diagonal(), function, mesh));
    return suggestedFor(function, mesh, use.samples != nullptr ? *use.samples : mesh::sampleVolume(mesh));
}

}  // namespace tetralux::projection
