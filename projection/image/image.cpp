// SPDX-License-Identifier: Apache-2.0
#include <projection/image/image.h>

#include <algorithm>
#include <bit>
#include <stdexcept>

#include <fmt/format.h>

namespace tetralux::projection {

namespace {

/// All bits of a float's exponent: those of infinities and of what is no number.
constexpr std::uint32_t exponentBits = 0x7f800000u;

std::uint32_t bitsOf(float value) {
    return std::bit_cast<std::uint32_t>(value);
}

/// By whole numbers and without branches, which compilers turn into vector code: every frame is asked.
bool isFinite(const glm::vec4* pixels, std::size_t count) {
    std::uint32_t beyond = 0;
    for (std::size_t i = 0; i < count; ++i)
        for (int channel = 0; channel < 4; ++channel)
            beyond |= (bitsOf(pixels[i][channel]) & exponentBits) == exponentBits ? 1u : 0u;
    return beyond == 0;
}

}  // namespace

std::vector<std::uint32_t> pixelsNotFinite(const Image& image) {
    constexpr std::size_t chunk = 1024;
    std::vector<std::uint32_t> found;
    for (std::size_t begin = 0; begin < image.pixels.size(); begin += chunk) {
        const std::size_t end = std::min(image.pixels.size(), begin + chunk);
        if (isFinite(&image.pixels[begin], end - begin)) continue;
        for (std::size_t i = begin; i < end; ++i)
            if (!isFinite(&image.pixels[i], 1)) found.push_back(static_cast<std::uint32_t>(i));
    }
    return found;
}

void requireFinite(const Image& image, const std::string& name) {
    const std::vector<std::uint32_t> pixels = pixelsNotFinite(image);
    if (pixels.empty()) return;
    const auto width = static_cast<std::uint32_t>(image.width);
    const glm::vec4& first = image.pixels[pixels.front()];
    throw std::runtime_error(fmt::format(
        "{}: {} of its pixels are beyond float, the first at ({}, {}): {}, {}, {}, {}; lower the extinction", name,
        pixels.size(), pixels.front() % width, pixels.front() / width, first.x, first.y, first.z, first.w));
}

void putUnder(Image& image, const glm::vec3& background) {
    for (glm::vec4& pixel : image.pixels) {
        const float transparency = 1.0f - pixel.w;
        pixel = {pixel.x + transparency * background.x, pixel.y + transparency * background.y,
                 pixel.z + transparency * background.z, 1.0f};
    }
}

}  // namespace tetralux::projection
