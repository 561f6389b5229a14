// SPDX-License-Identifier: Apache-2.0
#include <png.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <stdexcept>

#include <fmt/format.h>

#include <projection/image/image_codecs.h>

namespace tetralux::projection {

namespace {

/// [0, 1] to the nearest of 0…255; what is not a number becomes 0.
std::uint8_t toByte(float value) {
    if (!(value > 0.0f)) return 0;
    return static_cast<std::uint8_t>(std::lround(std::min(value, 1.0f) * 255.0f));
}

/// libpng's handle, freed whatever happens.
struct PngImage {
    png_image handle{};
    PngImage() { handle.version = PNG_IMAGE_VERSION; }
    PngImage(const PngImage&) = delete;
    PngImage& operator=(const PngImage&) = delete;
    ~PngImage() { png_image_free(&handle); }
};

}  // namespace

std::string encodePng(const Image& image, const std::string& name) {
    std::vector<std::uint8_t> rgb(image.pixels.size() * 3);
    for (std::size_t i = 0; i < image.pixels.size(); ++i)
        for (int channel = 0; channel < 3; ++channel)
            rgb[3 * i + static_cast<std::size_t>(channel)] = toByte(image.pixels[i][channel]);

    PngImage png;
    png.handle.width = static_cast<png_uint_32>(image.width);
    png.handle.height = static_cast<png_uint_32>(image.height);
    png.handle.format = PNG_FORMAT_RGB;
    // The size that libpng promises never to exceed, so that it encodes once.
    std::string bytes(PNG_IMAGE_PNG_SIZE_MAX(png.handle), '\0');
    png_alloc_size_t size = bytes.size();
    if (png_image_write_to_memory(&png.handle, bytes.data(), &size, 0, rgb.data(), 0, nullptr) == 0)
        throw std::runtime_error(
            fmt::format("{}: cannot be encoded as PNG ({}); choose a smaller size", name, png.handle.message));
    bytes.resize(size);
    return bytes;
}

Image decodePng(const std::string& bytes, const std::string& name) {
    PngImage png;
    const auto fail = [&] {
        return std::runtime_error(
            fmt::format("{}: is not a readable PNG ({}); give a whole .png or .exr file", name, png.handle.message));
    };
    if (png_image_begin_read_from_memory(&png.handle, bytes.data(), bytes.size()) == 0) throw fail();
    png.handle.format = PNG_FORMAT_RGBA;
    std::vector<std::uint8_t> rgba(PNG_IMAGE_SIZE(png.handle));
    if (png_image_finish_read(&png.handle, nullptr, rgba.data(), 0, nullptr) == 0) throw fail();

    Image image(static_cast<int>(png.handle.width), static_cast<int>(png.handle.height));
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
        const float alpha = static_cast<float>(rgba[4 * i + 3]) / 255.0f;  // PNG stores colours not multiplied by alpha
        for (int channel = 0; channel < 3; ++channel)
            image.pixels[i][channel] =
                static_cast<float>(rgba[4 * i + static_cast<std::size_t>(channel)]) / 255.0f * alpha;
        image.pixels[i].w = alpha;
    }
    return image;
}

}  // namespace tetralux::projection
