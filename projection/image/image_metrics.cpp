// SPDX-License-Identifier: Apache-2.0
#include <projection/image/image.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include <fmt/format.h>

namespace tetralux::projection {

namespace {

/// |a − b|; a value that is not a number differs infinitely from everything, so that it cannot hide in a maximum.
double channelDifference(float a, float b) {
    if (a == b) return 0.0;
    const double difference = std::abs(static_cast<double>(a) - static_cast<double>(b));
    return std::isnan(difference) ? std::numeric_limits<double>::infinity() : difference;
}

/// Smallest value that at least `fraction` of the values do not exceed.
double percentile(std::vector<double>& values, double fraction) {
    const auto rank = static_cast<std::size_t>(std::ceil(fraction * static_cast<double>(values.size())));
    const auto nth = values.begin() + static_cast<std::ptrdiff_t>(std::max<std::size_t>(rank, 1) - 1);
    std::nth_element(values.begin(), nth, values.end());
    return *nth;
}

}  // namespace

ImageDifference compareImages(const Image& a, const Image& b) {
    if (a.width != b.width || a.height != b.height)
        throw std::runtime_error(fmt::format("the images differ in size ({}x{} and {}x{}); compare images of one size",
                                             a.width, a.height, b.width, b.height));
    ImageDifference result;
    result.psnr = std::numeric_limits<double>::infinity();
    if (a.pixels.empty()) return result;

    std::vector<double> largest(a.pixels.size());
    double squares = 0.0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i) {
        for (int channel = 0; channel < 4; ++channel) {
            const double difference = channelDifference(a.pixels[i][channel], b.pixels[i][channel]);
            largest[i] = std::max(largest[i], difference);
            squares += difference * difference;
        }
        result.max = std::max(result.max, largest[i]);
    }
    const double meanSquare = squares / (4.0 * static_cast<double>(a.pixels.size()));
    result.rmse = std::sqrt(meanSquare);
    if (meanSquare > 0.0) result.psnr = -10.0 * std::log10(meanSquare);
    result.percentile999 = percentile(largest, 0.999);
    return result;
}

}  // namespace tetralux::projection
