// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <projection/image/image.h>

namespace tetralux::projection {

/// How a picture becomes a PNG. EXR holds all of it as it is.
struct PngOutput {
    /// With alpha: PNG stores colours that are not multiplied by it, C/α, as browsers and office programs compose them
    /// in display values: C + (1 − α)·background again, as putUnder has it. Light without alpha (Mode::Emission) is
    /// lost. Off: over black where it is not opaque.
    bool alpha = false;
    int bits = 8;  ///< of each channel: 8 or 16
};

/// The bytes of the file that writeImage writes at `path`, by its ending. \throws std::runtime_error
std::string imageFile(const Image& image, const std::string& path, const PngOutput& output);

/// writeImage with a choice. \throws std::runtime_error
void writeImage(const Image& image, const std::string& path, const PngOutput& output);

}  // namespace tetralux::projection
