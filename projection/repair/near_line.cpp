// SPDX-License-Identifier: Apache-2.0
#include <projection/repair/near_line.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <glm/common.hpp>

namespace tetralux::projection {

void addNearLine(glm::dvec2 a, glm::dvec2 b, PixelDistances wanted, const CameraFrame& frame,
                 std::vector<std::uint32_t>& pixels) {
    const int steep = std::abs(b.y - a.y) >= std::abs(b.x - a.x) ? 1 : 0, other = 1 - steep;
    const std::array size{frame.width, frame.height};
    if (a[steep] > b[steep]) std::swap(a, b);
    const double first = std::max(std::ceil(a[steep] - wanted.most), 0.0),
                 last = std::min(std::floor(b[steep] + wanted.most), size[static_cast<std::size_t>(steep)] - 1.0);
    for (double row = first; row <= last; ++row) {
        const double length = b[steep] - a[steep];
        const double share = length > 0 ? std::clamp((row - a[steep]) / length, 0.0, 1.0) : 0.0;
        const double place = glm::mix(a[other], b[other], share), nearest = std::round(place);
        const double distance = std::abs(place - nearest);
        if (!(distance >= wanted.least && distance < wanted.most)) continue;
        if (nearest < 0 || nearest >= size[static_cast<std::size_t>(other)]) continue;
        const double x = steep == 1 ? nearest : row, y = steep == 1 ? row : nearest;
        pixels.push_back(static_cast<std::uint32_t>(y) * static_cast<std::uint32_t>(frame.width) +
                         static_cast<std::uint32_t>(x));
    }
}

}  // namespace tetralux::projection
