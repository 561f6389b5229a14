// SPDX-License-Identifier: Apache-2.0
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>

#include <fmt/format.h>

#include <projection/image/image.h>
#include <projection/image/image_codecs.h>
#include <projection/image/whole_file.h>

namespace tetralux::projection {

namespace {

struct ImageFormat {
    const char* extension;
    std::string (*encode)(const Image&, const std::string& name, const PngOutput& output);
    Image (*decode)(const std::string& bytes, const std::string& name);
    bool numbers;  ///< float
};
constexpr ImageFormat formats[] = {{".png", encodePng, decodePng, false}, {".exr", encodeExr, decodeExr, true}};

const ImageFormat& formatOf(const std::string& path) {
    std::string extension = std::filesystem::path(path).extension().string();
    for (char& letter : extension)
        if (letter >= 'A' && letter <= 'Z') letter = static_cast<char>(letter - 'A' + 'a');
    for (const ImageFormat& format : formats)
        if (extension == format.extension) return format;
    throw std::runtime_error(fmt::format("{}: no image format has the ending '{}'; use .png or .exr", path, extension));
}

}  // namespace

bool holdsNumbers(const std::string& path) {
    return formatOf(path).numbers;
}

void checkImagePath(const std::string& path) {
    formatOf(path);
    checkWritable(path);
}

void writeImage(const Image& image, const std::string& path) {
    writeImage(image, path, {});
}

void writeImage(const Image& image, const std::string& path, const PngOutput& output) {
    writeWholeFile(path, imageFile(image, path, output));
}

std::string imageFile(const Image& image, const std::string& path, const PngOutput& output) {
    requireFinite(image, path);
    return formatOf(path).encode(image, path, output);
}

Image readImage(const std::string& path) {
    const ImageFormat& format = formatOf(path);
    std::error_code ignored;
    std::ifstream file(path, std::ios::binary);
    if (!file || std::filesystem::is_directory(path, ignored))
        throw std::runtime_error(fmt::format("{}: cannot be opened; check the name and that you may read it", path));
    const std::string bytes{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
    return format.decode(bytes, path);
}

}  // namespace tetralux::projection
