// SPDX-License-Identifier: Apache-2.0
/// \file
/// The two image formats, each with its library in one file: bytes in memory ↔ Image. `name` stands in messages.
#pragma once

#include <string>

#include <projection/image/image.h>
#include <projection/image/image_output.h>

namespace tetralux::projection {

/// Each channel is rounded to the nearest of the steps that the bits allow. \throws std::runtime_error
std::string encodePng(const Image& image, const std::string& name, const PngOutput& output);
Image decodePng(const std::string& bytes, const std::string& name);

/// 32-bit float RGBA, lossless. \throws std::runtime_error
std::string encodeExr(const Image& image, const std::string& name, const PngOutput& ignored);
Image decodeExr(const std::string& bytes, const std::string& name);

}  // namespace tetralux::projection
