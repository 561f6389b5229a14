// SPDX-License-Identifier: Apache-2.0
#include <projection/frame/verification.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <stdexcept>

#include <fmt/format.h>

#include <projection/core/scalar_range.h>
#include <projection/reference/reference_ray_caster.h>

namespace tetralux::projection {

namespace {

constexpr double normalQuantile95 = 1.6449;

/// Pixels of as many as were sampled that may be worse than the worst seen, with 95 % confidence; and how much worse.
constexpr double unseenPixels = 3.0, unseenFactor = 3.0;

std::vector<std::uint32_t> chosenPixels(std::size_t pixelCount, std::size_t samples, std::uint32_t seed) {
    std::vector<std::uint32_t> all(pixelCount), chosen;
    std::iota(all.begin(), all.end(), 0u);
    std::mt19937 random(seed);
    std::sample(all.begin(), all.end(), std::back_inserter(chosen), samples, random);  // keeps the ascending order
    return chosen;
}

}  // namespace

Verification verifyImage(const Image& image, const Scene& scene, const View& view, std::size_t samples,
                         std::uint32_t seed) {
    const Camera& camera = view.camera;
    if (image.width != camera.width || image.height != camera.height)
        throw std::runtime_error(
            fmt::format("verification: the image is {}x{}, the camera's {}x{}; verify the image as it was rendered",
                        image.width, image.height, camera.width, camera.height));
    const std::vector<std::uint32_t> pixels = chosenPixels(image.pixels.size(), samples, seed);
    Image exact(image.width, image.height);
    ReferenceRayCaster(withScalarsInRange(scene)).renderPixels(view, pixels, exact);
    if (view.maps != nullptr) composeBehind(exact, *view.maps);

    Verification result;
    result.pixels = pixels.size();
    if (pixels.empty()) return result;
    double sum = 0, sumOfSquares = 0, worst = 0;
    for (std::uint32_t pixel : pixels) {
        const glm::dvec4 difference = glm::dvec4(image.pixels[pixel]) - glm::dvec4(exact.pixels[pixel]);
        double square = 0;
        for (int channel = 0; channel < 4; ++channel) {
            // a NaN must not pass for a match
            const double size = std::isfinite(difference[channel]) ? std::abs(difference[channel]) : HUGE_VAL;
            square += 0.25 * size * size;
            result.max = std::max(result.max, size);
        }
        sum += square;
        sumOfSquares += square * square;
        worst = std::max(worst, square);
    }
    const double n = static_cast<double>(pixels.size()), all = static_cast<double>(image.pixels.size());
    const double mean = sum / n;
    const double variance = n > 1 ? std::max(0.0, (sumOfSquares - n * mean * mean) / (n - 1)) : 0.0;
    const double unsampled =
        all > 1 ? (all - n) / (all - 1) : 0.0;  // nothing is uncertain once every pixel is in the sample
    result.rmse = std::sqrt(mean);
    const double tail = unseenPixels / n * unseenFactor * unseenFactor * worst;
    result.rmseBound = std::sqrt(mean + normalQuantile95 * std::sqrt(variance / n * unsampled) + tail * unsampled);
    result.unseenShare = n < all ? std::min(1.0, unseenPixels / n) : 0.0;
    return result;
}

}  // namespace tetralux::projection
