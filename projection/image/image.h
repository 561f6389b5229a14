// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace tetralux::projection {

/// Linear premultiplied RGBA over nothing, row 0 at the top.
struct Image {
    int width = 0, height = 0;
    std::vector<glm::vec4> pixels;  ///< width·height, row by row

    Image() = default;
    Image(int w, int h) : width(w), height(h), pixels(static_cast<std::size_t>(w) * static_cast<std::size_t>(h)) {}
    glm::vec4& at(int x, int y) {
        return pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)];
    }
    const glm::vec4& at(int x, int y) const {
        return pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)];
    }
};

/// Differences over all four channels of all pixels.
struct ImageDifference {
    double rmse = 0.0, max = 0.0;
    double percentile999 = 0.0;  ///< 99.9th percentile of a pixel's largest channel difference
    double psnr = 0.0;           ///< decibels for peak 1; infinite for equal images
};

/// \throws std::runtime_error when the sizes differ.
ImageDifference compareImages(const Image& a, const Image& b);

/// The image over a colour: premultiplied composition, alpha becomes 1.
void putUnder(Image& image, const glm::vec3& background);

/// Pixels (y·width + x, ascending) one of whose channels is infinite or no number.
std::vector<std::uint32_t> pixelsNotFinite(const Image& image);

/// \throws std::runtime_error naming the first pixel that is not finite; `name` is the picture's.
void requireFinite(const Image& image, const std::string& name);

/// The picture in another size, by bilinear interpolation between pixel centres (made for enlarging: nothing is
/// averaged). \throws std::runtime_error for an image without pixels.
Image resized(const Image& image, int width, int height);

/// Writes `.png` (8 bits, over black where it is not opaque) or `.exr` (32-bit float RGBA) by extension. The file
/// appears whole or not at all: it is written beside and renamed. \throws std::runtime_error, also for a picture
/// that is not finite everywhere
void writeImage(const Image& image, const std::string& path);

/// Whether files with this ending hold any number, not only 0 … 1. \throws std::runtime_error for an unknown ending
bool holdsNumbers(const std::string& path);

/// Finds out before any work whether writeImage could write `path`: its ending, its folder, the right to write there.
/// \throws std::runtime_error
void checkImagePath(const std::string& path);

/// Reads what writeImage writes (8-bit PNG becomes [0, 1]). \throws std::runtime_error
Image readImage(const std::string& path);

}  // namespace tetralux::projection
