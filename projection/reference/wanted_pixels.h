// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace tetralux::projection {

/// Some pixels of an image, or all: answers at once whether a rectangle holds any (Crow's summed-area table, 1984).
class WantedPixels {
public:
    WantedPixels() = default;  ///< all
    WantedPixels(std::span<const std::uint32_t> pixels, int width, int height)
        : columns_(static_cast<std::size_t>(width) + 1), sums_(columns_ * (static_cast<std::size_t>(height) + 1)) {
        const auto w = static_cast<std::uint32_t>(width);
        for (std::uint32_t pixel : pixels) sums_[(pixel / w + 1) * columns_ + pixel % w + 1] = 1;
        for (std::size_t i = columns_ + 1; i < sums_.size(); ++i)
            if (i % columns_ != 0) sums_[i] += sums_[i - 1] + sums_[i - columns_] - sums_[i - columns_ - 1];
    }

    bool all() const { return sums_.empty(); }

    /// Of [x0, x1) × [y0, y1) within the image.
    bool any(int x0, int y0, int x1, int y1) const {
        if (all()) return true;
        if (x0 >= x1 || y0 >= y1) return false;
        auto sum = [&](int x, int y) {
            return sums_[static_cast<std::size_t>(y) * columns_ + static_cast<std::size_t>(x)];
        };
        return sum(x1, y1) - sum(x0, y1) - sum(x1, y0) + sum(x0, y0) != 0;
    }

private:
    std::size_t columns_ = 0;
    std::vector<std::uint32_t> sums_;  // wanted pixels above and left of a corner
};

}  // namespace tetralux::projection
