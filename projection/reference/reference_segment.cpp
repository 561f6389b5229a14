// SPDX-License-Identifier: Apache-2.0
#include <projection/reference/reference_segment.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include <glm/common.hpp>

#include <preint/value_from_above.h>

namespace tetralux::projection {

namespace {

using preint::ExactIntegral;

double pathOf(const RaySegment& segment, preint::Integral integral) {
    return integral == preint::Integral::Standard ? segment.tOut - segment.tIn
                                                  : std::abs(segment.scalarOut - segment.scalarIn);
}

bool crosses(const RaySegment& segment, const preint::Isosurface& surface) {
    return surface.opacity > 0 && glsl::crossesValue(segment.scalarIn, segment.scalarOut, surface.value);
}

/// The scalars from front to back at which the segment meets nodes, its ends included.
std::vector<double> scalarsAlong(const preint::TransferFunction& function, const RaySegment& segment) {
    const double low = std::min(segment.scalarIn, segment.scalarOut),
                 high = std::max(segment.scalarIn, segment.scalarOut);
    std::vector<double> scalars{low, high};
    const auto add = [&](double s) {
        if (s > low && s < high) scalars.push_back(s);
    };
    for (const auto& node : function.color) add(node.scalar);
    for (const auto& node : function.extinction) add(node.scalar);
    std::sort(scalars.begin(), scalars.end());
    if (segment.scalarIn > segment.scalarOut) std::reverse(scalars.begin(), scalars.end());
    return scalars;
}

/// ∫ c τ and ∫ τ.
struct Emission {
    glm::dvec3 light{0};
    double depth = 0.0;
};

/// Over the path, isosurfaces apart: c τ is quadratic between nodes, where Simpson's rule is exact.
Emission smoothEmission(const ExactIntegral& exact, const RaySegment& segment, preint::Integral integral) {
    const preint::TransferFunction& function = exact.function();
    const double path = pathOf(segment, integral), variation = std::abs(segment.scalarOut - segment.scalarIn);
    if (!(variation > 0)) {
        const double depth = path * function.extinctionAt(segment.scalarIn);
        return {depth * function.colorAt(segment.scalarIn), depth};
    }
    Emission sum;
    const std::vector<double> scalars = scalarsAlong(function, segment);
    for (std::size_t i = 0; i + 1 < scalars.size(); ++i) {
        const double low = std::min(scalars[i], scalars[i + 1]), high = std::max(scalars[i], scalars[i + 1]);
        const auto a = exact.valueFromAbove(low), b = exact.valueFromBelow(high);
        const double length = path * (high - low) / variation;
        const glm::dvec3 middle = 0.25 * (a.color + b.color) * (a.extinction + b.extinction);
        sum.light += length / 6.0 * (a.color * a.extinction + 4.0 * middle + b.color * b.extinction);
        sum.depth += length * 0.5 * (a.extinction + b.extinction);
    }
    return sum;
}

UnshadedSegment emission(const ExactIntegral& exact, const RaySegment& segment, preint::Integral integral) {
    const Emission smooth = smoothEmission(exact, segment, integral);
    glm::dvec3 light = smooth.light;
    double depth = smooth.depth;
    for (const auto& surface : exact.function().isosurfaces)
        if (crosses(segment, surface)) {
            light += surface.opacity * surface.color;
            depth += surface.opacity;
        }
    return {depth > 0 ? light / depth : glm::dvec3(0), depth, smooth.depth};
}

/// Barycentric coordinates of a point in a cell.
std::array<double, 4> coordinatesIn(const mesh::ScalarMesh& mesh, mesh::CellIndex cell, const glm::dvec3& point) {
    std::array<glm::dvec3, 4> p;
    for (std::size_t k = 0; k < 4; ++k) p[k] = mesh.positions[mesh.cells[cell][k]];
    const double whole = mesh::sixVolumes(p[0], p[1], p[2], p[3]);
    std::array<double, 4> coordinates;
    for (std::size_t k = 0; k < 4; ++k) {
        auto q = p;
        q[k] = point;
        coordinates[k] = mesh::sixVolumes(q[0], q[1], q[2], q[3]) / whole;
    }
    return coordinates;
}

UnshadedSegment sampled(const ExactIntegral& exact, const Scene& scene, const RaySegment& segment,
                        const glm::dvec3& middle) {
    const preint::TransferFunction& function = exact.function();
    const double path = pathOf(segment, integralOf(scene.settings.mode));
    UnshadedSegment result;
    if (scene.settings.classification == Classification::Pre) {
        const auto coordinates = coordinatesIn(*scene.mesh, segment.cell, middle);
        double extinction = 0;
        for (int k = 0; k < 4; ++k) {
            const double scalar = scene.mesh->scalarAt(segment.cell, k),
                         weight = coordinates[static_cast<std::size_t>(k)];
            extinction += weight * function.extinctionAt(scalar);
            result.meanColor += weight * function.colorAt(scalar);
        }
        result.smoothDepth = std::max(extinction, 0.0) * path;
    } else {
        const double scalar = 0.5 * segment.scalarIn + 0.5 * segment.scalarOut;
        result.smoothDepth = function.extinctionAt(scalar) * path;
        result.meanColor = function.colorAt(scalar);
    }
    result.depth = result.smoothDepth;
    return result;
}

/// ContributionWeights::perCell.
UnshadedSegment cellContributions(const ExactIntegral& exact, const Scene& scene, const RaySegment& segment,
                                  const glm::dvec3& middle, double scale) {
    glm::dvec3 colors(0);
    double count = 0;
    const auto add = [&](const glm::dvec3& color) {
        colors += color;
        count += 1;
    };
    if (scene.settings.classification != Classification::Preintegrated) {
        const UnshadedSegment sample = sampled(exact, scene, segment, middle);
        if (sample.depth > 0) add(sample.meanColor);
    } else {
        const Emission smooth = smoothEmission(exact, segment, integralOf(scene.settings.mode));
        if (smooth.depth > 0) add(smooth.light / smooth.depth);
        for (const auto& surface : exact.function().isosurfaces)
            if (crosses(segment, surface)) add(surface.color);
    }
    return {count > 0 ? colors / count : glm::dvec3(0), count * scale, 0.0};
}

}  // namespace

UnshadedSegment unshadedSegment(const ExactIntegral& exact, const Scene& scene, const RaySegment& segment,
                                const glm::dvec3& middle, double scale) {
    const preint::Integral integral = integralOf(scene.settings.mode);
    if (scene.settings.contributions.perCell) return cellContributions(exact, scene, segment, middle, scale);
    if (scene.settings.classification != Classification::Preintegrated) return sampled(exact, scene, segment, middle);
    if (addsUp(scene.settings.mode)) return emission(exact, segment, integral);
    const double length = segment.tOut - segment.tIn;
    const auto whole = exact.segment(segment.scalarIn, segment.scalarOut, length, integral);
    const glm::dvec3 meanColor = whole.opacity() > 0 ? whole.color / whole.opacity() : glm::dvec3(0);
    return {meanColor, whole.opticalDepth,
            exact.smoothSegment(segment.scalarIn, segment.scalarOut, length, integral).opticalDepth};
}

std::optional<double> firstShownAt(const ExactIntegral& exact, const RaySegment& segment) {
    const double from = segment.scalarIn, to = segment.scalarOut;
    if (from == to) return exact.function().extinctionAt(from) > 0 ? std::optional(segment.tIn) : std::nullopt;
    std::optional<double> first;  // scalar
    const auto meet = [&](double scalar) {
        if (!first || std::abs(scalar - from) < std::abs(*first - from)) first = scalar;
    };
    const std::vector<double> scalars = scalarsAlong(exact.function(), segment);
    for (std::size_t i = 0; i + 1 < scalars.size(); ++i) {
        const double low = std::min(scalars[i], scalars[i + 1]), high = std::max(scalars[i], scalars[i + 1]);
        if (exact.valueFromAbove(low).extinction > 0 || exact.valueFromBelow(high).extinction > 0) meet(scalars[i]);
    }
    for (const auto& surface : exact.function().isosurfaces)
        if (crosses(segment, surface)) meet(surface.value);
    if (!first) return std::nullopt;
    return glm::mix(segment.tIn, segment.tOut, (*first - from) / (to - from));
}

bool limit(RaySegment& segment, double nearest, double farthest) {
    const double tIn = std::max(segment.tIn, nearest), tOut = std::min(segment.tOut, farthest);
    if (!(tOut > tIn)) return false;
    const double from = segment.scalarIn, to = segment.scalarOut, start = segment.tIn;
    const double length = segment.tOut - segment.tIn;
    if (tIn > segment.tIn) segment.scalarIn = scalarBetween(from, to, (tIn - start) / length);
    if (tOut < segment.tOut) segment.scalarOut = scalarBetween(from, to, (tOut - start) / length);
    segment.tIn = tIn;
    segment.tOut = tOut;
    return true;
}

void splitAtLayerEnd(std::vector<RaySegment>& segments, double layerEnd) {
    for (std::size_t i = 0, count = segments.size(); i < count; ++i) {
        RaySegment& segment = segments[i];
        segment.inCutLayer = segment.tIn < layerEnd;
        if (!segment.inCutLayer || !(segment.tOut > layerEnd)) continue;
        RaySegment behind = segment;
        behind.inCutLayer = false;
        behind.scalarIn = segment.scalarOut =
            scalarBetween(segment.scalarIn, segment.scalarOut, (layerEnd - segment.tIn) / (segment.tOut - segment.tIn));
        behind.tIn = segment.tOut = layerEnd;
        segments.push_back(behind);
    }
}

preint::TransferFunction scaledExtinction(preint::TransferFunction function, double scale) {
    for (auto& node : function.extinction) node.extinction *= scale;
    for (auto& surface : function.isosurfaces)
        surface.opacity = surface.opacity < 1 ? -std::expm1(scale * std::log1p(-surface.opacity))
                          : scale > 0         ? 1.0
                                              : 0.0;
    return function;
}

}  // namespace tetralux::projection
