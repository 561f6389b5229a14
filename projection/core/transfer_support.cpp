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

// Appends what lies between two nodes; where its low end has extinction too, that continues the interval before.
void append(std::vector<ShownScalars>& support, double low, double high, bool lowShows) {
    if (lowShows && !support.empty() && support.back().high == low) {
        support.back().high = high;
    } else {
        support.push_back({low, high, lowShows});
    }
}

bool crossesIsosurface(const preint::TransferFunction& function, double low, double high) {
    return std::any_of(function.isosurfaces.begin(), function.isosurfaces.end(),
                       [&](const preint::Isosurface& surface) {
                           return surface.opacity > 0 && glsl::crossesValue(low, high, surface.value);
                       });
}

}  // namespace

std::vector<ShownScalars> extinctionSupport(const preint::TransferFunction& function) {
    std::vector<ShownScalars> support;
    const auto& nodes = function.extinction;
    if (nodes.empty()) return support;
    if (nodes.front().extinction > 0) append(support, -infinity, nodes.front().scalar, false);
    for (std::size_t i = 0; i + 1 < nodes.size(); ++i) {
        const auto &low = nodes[i], &high = nodes[i + 1];
        if (low.scalar == high.scalar || (low.extinction <= 0 && high.extinction <= 0)) continue;
        append(support, low.scalar, high.scalar, low.extinction > 0);
    }
    if (nodes.back().extinction > 0) append(support, nodes.back().scalar, infinity, true);
    return support;
}

bool rangeShows(const preint::TransferFunction& function, const std::vector<ShownScalars>& support, double low,
                double high, preint::Integral integral) {
    if (integral == preint::Integral::ScaleInvariant && low == high) return false;
    return std::any_of(support.begin(), support.end(),
                       [&](const ShownScalars& shown) { return shown.meets(low, high); }) ||
           crossesIsosurface(function, low, high);
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
    for (const ShownScalars& shown : extinctionSupport(function)) {
        meet(function.colorAt(std::max(shown.low, -far)));
        meet(function.colorAt(std::nextafter(std::min(shown.high, far), -far)));
        for (const preint::ColorNode& node : function.color)
            if (node.scalar > shown.low && node.scalar < shown.high) meet(node.color);
    }
    for (const preint::Isosurface& surface : function.isosurfaces)
        if (surface.opacity > 0) meet(surface.color);
    if (differs) return std::nullopt;
    return only.value_or(glm::dvec3(0));
}

ScalarColors::ScalarColors(const preint::TransferFunction& function, bool exact) : function_(function) {
    constexpr double rounding = 0x1p-21, largestChange = 5e-5;  // of scalars, and of a colour
    auto& nodes = function_.color;
    for (preint::ColorNode& node : nodes) node.scalar = static_cast<double>(static_cast<float>(node.scalar));
    for (std::size_t i = 0; i + 1 < nodes.size(); ++i) {
        const glm::dvec3 change = glm::abs(nodes[i + 1].color - nodes[i].color);
        const double width = nodes[i + 1].scalar - nodes[i].scalar, most = std::max({change.x, change.y, change.z});
        if (!(most * std::min(1.0, 2.0 * rounding / std::max(width, 1e-300)) > largestChange)) continue;
        if (exact && function.color[i].scalar == function.color[i + 1].scalar) continue;
        const glm::vec2 range(nodes[i].scalar - rounding, nodes[i + 1].scalar + rounding);
        if (!uncertain_.empty() && range.x <= uncertain_.back().y)
            uncertain_.back().y = range.y;
        else
            uncertain_.push_back(range);
    }
}

bool ScalarColors::isUncertain(float scalar) const {
    return std::any_of(uncertain_.begin(), uncertain_.end(),
                       [&](const glm::vec2& range) { return scalar >= range.x && scalar <= range.y; });
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
    if (crossesIsosurface(exact_.function(), low, high)) return true;
    const double extent = integral_ == preint::Integral::ScaleInvariant ? high - low : longestEdge(mesh_, cell);
    return exact_.largestExtinction(low, high) * extent > leastDepth_;
}

}  // namespace tetralux::projection
