// SPDX-License-Identifier: Apache-2.0
#include <projection/transfer_support.h>

#include <algorithm>
#include <limits>

namespace tetralux::projection {
namespace {

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

std::vector<glm::dvec2> extinctionSupport(const preint::TransferFunction& function) {
    std::vector<glm::dvec2> support;
    const auto& nodes = function.extinction;
    if (nodes.empty()) return support;
    const double nudge = 1e-7 * (nodes.back().scalar - nodes.front().scalar);
    if (nodes.front().extinction > 0) support.emplace_back(-infinity, nodes.front().scalar);
    for (std::size_t i = 0; i + 1 < nodes.size(); ++i) {
        const auto &low = nodes[i], &high = nodes[i + 1];
        if (low.scalar == high.scalar || (low.extinction <= 0 && high.extinction <= 0)) continue;
        const bool jumpsUp = low.extinction > 0 && function.extinctionAt(low.scalar) > 0 &&
                             (support.empty() || support.back().y != low.scalar);
        append(support, jumpsUp ? low.scalar - nudge : low.scalar, high.scalar, low.extinction > 0);
    }
    if (nodes.back().extinction > 0) append(support, nodes.back().scalar, infinity, true);
    return support;
}

bool rangeShows(const preint::TransferFunction& function, const std::vector<glm::dvec2>& support, double low, double high,
                preint::Integral integral) {
    if (integral == preint::Integral::ScaleInvariant && low == high) return false;
    if (std::any_of(support.begin(), support.end(),
                    [&](const glm::dvec2& interval) { return high > interval.x && low < interval.y; })) {
        return true;
    }
    return std::any_of(function.isosurfaces.begin(), function.isosurfaces.end(), [&](const preint::Isosurface& surface) {
        return surface.opacity > 0 && low < surface.value && surface.value <= high;
    });
}

}  // namespace tetralux::projection
