// SPDX-License-Identifier: Apache-2.0
#include <png.h>

#include <algorithm>
#include <cmath>
#include <csetjmp>
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

namespace {

/// The channels that are stored, between 0 and 1, pixel by pixel.
std::vector<float> storedChannels(const Image& image, bool alpha) {
    std::vector<float> channels;
    channels.reserve(image.pixels.size() * (alpha ? 4 : 3));
    for (const glm::vec4& pixel : image.pixels) {
        const float opacity = alpha ? std::clamp(pixel.w, 0.0f, 1.0f) : 1.0f;
        for (int channel = 0; channel < 3; ++channel)
            channels.push_back(opacity > 0.0f ? std::clamp(pixel[channel] / opacity, 0.0f, 1.0f) : 0.0f);
        if (alpha) channels.push_back(opacity);
    }
    return channels;
}

/// The nearest of 0…255 or 0…65535, the high byte first.
std::vector<std::uint8_t> packed(const std::vector<float>& channels, int bits) {
    std::vector<std::uint8_t> bytes;
    bytes.reserve(channels.size() * static_cast<std::size_t>(bits / 8));
    for (const float value : channels) {
        const auto step =
            static_cast<std::uint32_t>(std::lround(static_cast<double>(value) * (bits == 16 ? 65535 : 255)));
        if (bits == 16) bytes.push_back(static_cast<std::uint8_t>(step >> 8));
        bytes.push_back(static_cast<std::uint8_t>(step & 0xff));
    }
    return bytes;
}

void appendBytes(png_structp png, png_bytep data, std::size_t size) {
    static_cast<std::string*>(png_get_io_ptr(png))->append(reinterpret_cast<const char*>(data), size);
}

/// libpng's own errors leave by longjmp, so that nothing here may need a destructor. \returns whether it is whole.
bool encodeRows(png_structp png, png_infop info, const Image& image, std::uint8_t* bytes, std::size_t rowBytes,
                const PngOutput& output, std::string& result) {
    if (setjmp(png_jmpbuf(png)) != 0) return false;
    png_set_write_fn(png, &result, appendBytes, nullptr);
    png_set_IHDR(png, info, static_cast<png_uint_32>(image.width), static_cast<png_uint_32>(image.height), output.bits,
                 output.alpha ? PNG_COLOR_TYPE_RGBA : PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    png_set_sRGB(png, info, PNG_sRGB_INTENT_PERCEPTUAL);
    png_write_info(png, info);
    for (int y = 0; y < image.height; ++y) png_write_row(png, bytes + static_cast<std::size_t>(y) * rowBytes);
    png_write_end(png, info);
    return true;
}

std::string encodeWithAlphaOrDepth(const Image& image, const std::string& name, const PngOutput& output) {
    std::vector<std::uint8_t> bytes = packed(storedChannels(image, output.alpha), output.bits);
    std::string result;
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
    png_infop info = png != nullptr ? png_create_info_struct(png) : nullptr;
    const bool good = info != nullptr &&
                      encodeRows(png, info, image, bytes.data(),
                                 bytes.size() / static_cast<std::size_t>(std::max(1, image.height)), output, result);
    png_destroy_write_struct(&png, &info);
    if (!good) throw std::runtime_error(fmt::format("{}: cannot be encoded as PNG; choose a smaller size", name));
    return result;
}

}  // namespace

std::string encodePng(const Image& image, const std::string& name, const PngOutput& output) {
    if (output.alpha || output.bits == 16) return encodeWithAlphaOrDepth(image, name, output);
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
