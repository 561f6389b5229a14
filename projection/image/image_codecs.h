// SPDX-License-Identifier: Apache-2.0
/// \file
/// The two image formats, each with its library in one file: bytes in memory ↔ Image. `name` stands in messages.
#pragma once

#include <string>

#include <projection/image/image.h>

namespace tetralux::projection {

/// 8-bit RGB over black, each channel rounded to the nearest of 0…255. \throws std::runtime_error
std::string encodePng(const Image& image, const std::string& name);
Image decodePng(const std::string& bytes, const std::string& name);

/// 32-bit float RGBA, lossless. \throws std::runtime_error
std::string encodeExr(const Image& image, const std::string& name);
Image decodeExr(const std::string& bytes, const std::string& name);

}  // namespace tetralux::projection
