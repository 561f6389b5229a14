// SPDX-License-Identifier: Apache-2.0
#include <projection/frame/verification.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <stdexcept>

#include <fmt/format.h>

#include <projection/core/scalar_range.h>
#include <projection/frame/sampled_engine.h>

namespace tetralux::projection {

namespace {

constexpr double missedChance = 0.05;  // of not meeting any of the pixels that are worse

/// The smallest number in [low, high] for which `holds`, which does from some number on; `high` where it never does.
template <class Predicate>
std::size_t firstThatHolds(std::size_t low, std::size_t high, Predicate holds) {
    while (low < high) {
        const std::size_t middle = low + (high - low) / 2;
        if (holds(middle))
            high = middle;
        else
            low = middle + 1;
    }
    return low;
}

/// The largest number of bad pixels among `all` of which a sample of `seen` meets none with more than missedChance.
std::size_t mostMissed(std::size_t all, std::size_t seen) {
    if (seen == 0) return all;
    const auto logFactorial = [](std::size_t n) { return std::lgamma(static_cast<double>(n) + 1.0); };
    const auto missed = [&](std::size_t bad) {  // C(all − bad, seen)/C(all, seen)
        return logFactorial(all - bad) - logFactorial(all - bad - seen) - logFactorial(all) + logFactorial(all - seen);
    };
    const std::size_t unseen = all - seen;
    const std::size_t tooMany = firstThatHolds(
        1, unseen + 1, [&](std::size_t bad) { return bad > unseen || missed(bad) < std::log(missedChance); });
    return tooMany - 1;
}

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
    castPixels(withScalarsInRange(scene), camera, view.maps, pixels, exact);

    Verification result;
    result.pixels = pixels.size();
    result.allPixels = image.pixels.size();
    for (const glm::vec4& pixel : image.pixels)
        for (int channel = 0; channel < 4; ++channel)
            if (std::isfinite(pixel[channel]))
                result.largest = std::max(result.largest, std::abs(static_cast<double>(pixel[channel])));
    double sum = 0;
    for (std::uint32_t pixel : pixels) {
        const glm::dvec4 difference = glm::dvec4(image.pixels[pixel]) - glm::dvec4(exact.pixels[pixel]);
        for (int channel = 0; channel < 4; ++channel) {
            // a NaN must not pass for a match
            const double size = std::isfinite(difference[channel]) ? std::abs(difference[channel]) : HUGE_VAL;
            sum += 0.25 * size * size;
            result.max = std::max(result.max, size);
        }
    }
    const auto number = [](std::size_t count) { return static_cast<double>(count); };
    result.unseenWorse = mostMissed(result.allPixels, result.pixels);
    result.largest = std::max(result.largest, result.max);
    if (result.pixels > 0) result.rmse = std::sqrt(sum / number(result.pixels));
    const std::size_t like = result.unseen() - result.unseenWorse;
    if (like > 0) sum += number(like) * result.max * result.max;
    sum += number(result.unseenWorse) * result.largest * result.largest;
    if (result.allPixels > 0) result.rmseBound = std::sqrt(sum / number(result.allPixels));
    return result;
}

double Verification::unseenShare() const {
    return allPixels > 0 ? static_cast<double>(unseenWorse) / static_cast<double>(allPixels) : 0.0;
}

std::size_t pixelsToVouchFor(double maxError, std::size_t allPixels, double largest) {
    const double allowed = maxError / largest * (maxError / largest) * static_cast<double>(allPixels);
    return firstThatHolds(
        1, allPixels, [&](std::size_t seen) { return static_cast<double>(mostMissed(allPixels, seen)) <= allowed; });
}

}  // namespace tetralux::projection
