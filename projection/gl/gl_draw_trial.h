// SPDX-License-Identifier: Apache-2.0
/// \file
/// Which of two ways of drawing is the faster here: by trying.
#pragma once

#include <cstdint>
#include <string>

namespace tetralux::projection {

/// The ways that `--gl-path measured` chooses from (gl_path.h).
enum class GlDrawing { Raster, Tiles };

/// Draws the first frames of a scene's size by turns, three each. The first of each way compiles and warms up and does
/// not count; of the others the least time does. Then the faster way stays, until the image has more than twice or less
/// than half its pixels, or a frame draws more than four times or less than a quarter of the cells of those frames:
/// then it is tried again.
///
/// Times are wall times of a whole frame on the GPU (cull, sort, set-up, draw, waited for), which are the same but for
/// the drawing: timer queries say the same on GPUs, and nothing true on software renderers.
class GlDrawTrial {
public:
    /// How the next frame, of so many pixels, is to be drawn.
    GlDrawing next(std::uint64_t pixels);

    /// How long the frame that next() was asked for took.
    void took(double milliseconds, std::uint64_t cellsDrawn);

    /// One line for reports: what was measured, or that it is being measured.
    std::string reason() const;

private:
    static constexpr int framesOfEach = 3;
    bool decided() const { return frames_ >= 2 * framesOfEach; }
    void restart();

    std::uint64_t pixels_ = 0, cells_ = 0;
    int frames_ = 0;
    double least_[2] = {0, 0};
    GlDrawing current_ = GlDrawing::Raster;
};

}  // namespace tetralux::projection
