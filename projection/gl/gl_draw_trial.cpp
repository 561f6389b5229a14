// SPDX-License-Identifier: Apache-2.0
#include <projection/gl/gl_draw_trial.h>

#include <algorithm>
#include <limits>

#include <fmt/format.h>

namespace tetralux::projection {
namespace {

bool withinFactor(std::uint64_t a, std::uint64_t b, std::uint64_t factor) {
    return a <= factor * b && b <= factor * a;
}

}  // namespace

void GlDrawTrial::restart() {
    frames_ = 0;
    std::fill(least_, least_ + 2, std::numeric_limits<double>::infinity());
}

GlDrawing GlDrawTrial::next(std::uint64_t pixels) {
    if (frames_ == 0 || !withinFactor(pixels, pixels_, 2)) {
        restart();
        pixels_ = pixels;
    }
    if (!decided()) {
        current_ = frames_ % 2 == 0 ? GlDrawing::Raster : GlDrawing::Tiles;
    } else {
        current_ = least_[1] < least_[0] ? GlDrawing::Tiles : GlDrawing::Raster;
    }
    return current_;
}

void GlDrawTrial::took(double milliseconds, std::uint64_t cellsDrawn) {
    if (frames_ == 0) cells_ = cellsDrawn;
    if (!withinFactor(cellsDrawn, cells_, 4)) return restart();
    if (decided()) return;
    double& least = least_[static_cast<int>(current_)];
    if (frames_ >= 2) least = std::min(least, milliseconds);
    ++frames_;
}

std::string GlDrawTrial::reason() const {
    if (!decided()) return "being measured";
    return fmt::format("measured: raster {:.3g} ms, tiles {:.3g} ms", least_[0], least_[1]);
}

}  // namespace tetralux::projection
