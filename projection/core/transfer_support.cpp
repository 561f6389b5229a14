// SPDX-License-Identifier: Apache-2.0
#include <projection/core/transfer_support.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace tetralux::projection {
namespace {

/// Half the step of float at 1.
constexpr double leastOpacity = 0x1p-25;

/// Edge of the cell that no segment in it can exceed, mesh units.
double longestEdge(const mesh::ScalarMesh& mesh, mesh::CellIndex cell) {
    double squared = 0.0;
    for (std::size_t i = 0; i < 4; ++i) {
        for (std::size_t j = i + 1; j < 4; ++j) {
            const glm::dvec3 edge = mesh.positions[mesh.cells[cell][j]] - mesh.positions[mesh.cells[cell][i]];
            squared = std::max(squared, glm::dot(edge, edge));
        }
    }
    return std::sqrt(squared);
}

constexpr double infinity = std::numeric_limits<double>::infinity();

// Appends (low, high); `joined` when its low end has extinction too, and so continues the interval before.
void append(std::vector<glm::dvec2>& support, double low, double high, bool joined) {
    if (joined && !support.empty() && support.back().y == low) {
        support.back().y = high;
    } else {
        support.emplace_back(low, high);
    }
}

}  // namespace

namespace {

/// `lowered(s)` is where an interval begins whose extinction jumps up at s.
template <class Lowered>
std::vector<glm::dvec2> supportOf(const preint::TransferFunction& function, Lowered lowered) {
    std::vector<glm::dvec2> support;
    const auto& nodes = function.extinction;
    if (nodes.empty()) return support;
    if (nodes.front().extinction > 0) support.emplace_back(-infinity, nodes.front().scalar);
    for (std::size_t i = 0; i + 1 < nodes.size(); ++i) {
        const auto &low = nodes[i], &high = nodes[i + 1];
        if (low.scalar == high.scalar || (low.extinction <= 0 && high.extinction <= 0)) continue;
        const bool jumpsUp = low.extinction > 0 && function.extinctionAt(low.scalar) > 0 &&
                             (support.empty() || support.back().y != low.scalar);
        append(support, jumpsUp ? lowered(low.scalar) : low.scalar, high.scalar, low.extinction > 0);
    }
    if (nodes.back().extinction > 0) append(support, nodes.back().scalar, infinity, true);
    return support;
}

}  // namespace

std::vector<glm::dvec2> extinctionSupport(const preint::TransferFunction& function) {
    return supportOf(function, [](double scalar) { return std::nextafter(scalar, -infinity); });
}

std::vector<glm::vec2> floatExtinctionSupport(const preint::TransferFunction& function) {
    const auto& nodes = function.extinction;
    const double nudge = nodes.empty() ? 0.0 : 1e-7 * (nodes.back().scalar - nodes.front().scalar);
    std::vector<glm::vec2> support;
    for (const glm::dvec2& interval : supportOf(function, [&](double scalar) { return scalar - nudge; }))
        support.push_back(glm::clamp(glm::vec2(interval), -3e38f, 3e38f));
    return support;
}

bool rangeShows(const preint::TransferFunction& function, const std::vector<glm::dvec2>& support, double low,
                double high, preint::Integral integral) {
    if (integral == preint::Integral::ScaleInvariant && low == high) return false;
    if (std::any_of(support.begin(), support.end(),
                    [&](const glm::dvec2& interval) { return high > interval.x && low < interval.y; })) {
        return true;
    }
    return std::any_of(function.isosurfaces.begin(), function.isosurfaces.end(),
                       [&](const preint::Isosurface& surface) {
                           return surface.opacity > 0 && low < surface.value && surface.value <= high;
                       });
}

namespace {

/// Whether opacity below float's step may show: modes that take any for something, and what makes it larger.
bool anyOpacityCounts(const RenderSettings& settings) {
    return settings.mode == Mode::FirstHit || settings.mode == Mode::Depth || settings.contributions.any() ||
           settings.shading.silhouette || settings.shading.gradientOpacity > 0 || settings.largestExtinctionScale > 1.0;
}

}  // namespace

std::optional<glm::dvec3> onlyColor(const preint::TransferFunction& function) {
    constexpr double far = std::numeric_limits<double>::max();
    std::optional<glm::dvec3> only;
    bool differs = false;
    auto meet = [&](const glm::dvec3& color) {
        differs = differs || (only && *only != color);
        only = color;
    };
    for (const glm::dvec2& interval : extinctionSupport(function)) {
        meet(function.colorAt(std::max(interval.x, -far)));
        meet(function.colorAt(std::nextafter(std::min(interval.y, far), -far)));
        for (const preint::ColorNode& node : function.color)
            if (node.scalar > interval.x && node.scalar < interval.y) meet(node.color);
    }
    for (const preint::Isosurface& surface : function.isosurfaces)
        if (surface.opacity > 0) meet(surface.color);
    if (differs) return std::nullopt;
    return only.value_or(glm::dvec3(0));
}

CellVisibility::CellVisibility(const mesh::ScalarMesh& mesh, const preint::TransferFunction& function,
                               const RenderSettings& settings)
    : mesh_(mesh),
      integral_(integralOf(settings.mode)),
      exact_(function),
      support_(extinctionSupport(function)),
      leastDepth_(anyOpacityCounts(settings) ? 0.0 : leastOpacity) {}

bool CellVisibility::shows(mesh::CellIndex cell) const {
    const glm::dvec2 scalars = scalarRange(mesh_, cell);
    const double low = scalars.x, high = scalars.y;
    if (!rangeShows(exact_.function(), support_, low, high, integral_)) return false;
    const auto& surfaces = exact_.function().isosurfaces;
    if (std::any_of(surfaces.begin(), surfaces.end(), [&](const auto& s) { return low < s.value && s.value <= high; }))
        return true;
    const double extent = integral_ == preint::Integral::ScaleInvariant ? high - low : longestEdge(mesh_, cell);
    return exact_.largestExtinction(low, high) * extent > leastDepth_;
}

}  // namespace tetralux::projection
