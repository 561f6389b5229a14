// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include <projection/image/image.h>

namespace tetralux::projection {

namespace {

/// Between which two pixels of a row of `from` pixels the pixel `i` of `to` lies, and how far on the way.
struct Place {
    int low, high;
    float fraction;
};

Place placeOf(int i, int from, int to) {
    const double at = std::clamp((i + 0.5) * from / to - 0.5, 0.0, from - 1.0);
    const int low = static_cast<int>(at);
    return {low, std::min(low + 1, from - 1), static_cast<float>(at - low)};
}

}  // namespace

Image resized(const Image& image, int width, int height) {
    if (image.pixels.empty() || width < 1 || height < 1)
        throw std::runtime_error(fmt::format("image of {}x{}: cannot be made {}x{}; each side needs a pixel",
                                             image.width, image.height, width, height));
    if (image.width == width && image.height == height) return image;
    Image result(width, height);
    for (int y = 0; y < height; ++y) {
        const Place row = placeOf(y, image.height, height);
        for (int x = 0; x < width; ++x) {
            const Place column = placeOf(x, image.width, width);
            const auto across = [&](int from) {
                return (1.0f - column.fraction) * image.at(column.low, from) +
                       column.fraction * image.at(column.high, from);
            };
            result.at(x, y) = (1.0f - row.fraction) * across(row.low) + row.fraction * across(row.high);
        }
    }
    return result;
}

}  // namespace tetralux::projection
