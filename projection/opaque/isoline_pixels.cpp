// SPDX-License-Identifier: Apache-2.0
#include <projection/opaque/isoline_pixels.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <projection/cells/point_pixel.h>

namespace tetralux::projection {

namespace {

struct PixelLine {
    glm::dvec2 from, to;
};

/// The part of a line in front of the eye, in the image. A line in space is one there.
std::optional<PixelLine> seen(const CameraFrame& frame, const mesh::IsolineSegment& segment) {
    const PointPixel pixelOf(frame);
    glm::dvec3 a = segment.from - frame.eye, b = segment.to - frame.eye;
    double depthA = pixelOf.depth(a), depthB = pixelOf.depth(b);
    if (!frame.orthographic) {
        if (depthA > depthB) {
            std::swap(a, b);
            std::swap(depthA, depthB);
        }
        if (!(depthB > 0)) return std::nullopt;
        const double nearest = 1e-6 * depthB;
        if (depthA < nearest) {
            a = glm::mix(a, b, (nearest - depthA) / (depthB - depthA));
            depthA = nearest;
        }
    }
    return PixelLine{pixelOf(a, depthA), pixelOf(b, depthB)};
}

double distance2(const glm::dvec2& point, const glm::dvec2& from, const glm::dvec2& to) {
    const glm::dvec2 along = to - from, p = point - from;
    const double length2 = glm::dot(along, along);
    const glm::dvec2 off = p - (length2 > 0 ? std::clamp(glm::dot(p, along) / length2, 0.0, 1.0) : 0.0) * along;
    return glm::dot(off, off);
}

/// Whole pixels from `low` to `high`, within [from, to).
struct PixelRun {
    int begin, end;
    PixelRun(double low, double high, int from, int to)
        : begin(static_cast<int>(std::clamp(std::ceil(low), double(from), double(to)))),
          end(static_cast<int>(std::clamp(std::floor(high) + 1.0, double(from), double(to)))) {}
};

}  // namespace

IsolinePixels::IsolinePixels(const CameraFrame& frame, const std::vector<mesh::IsolineSegment>& segments, double width,
                             int tileSize)
    : width_(width),
      tileSize_(tileSize),
      tilesAcross_(static_cast<std::size_t>((frame.width + tileSize - 1) / tileSize)),
      size_(frame.width, frame.height),
      tiles_(tilesAcross_ * static_cast<std::size_t>((frame.height + tileSize - 1) / tileSize)) {
    for (const mesh::IsolineSegment& segment : segments)
        if (const auto line = seen(frame, segment)) segments_.push_back({line->from, line->to, segment.value});
    bin();
}

void IsolinePixels::bin() {
    const double reach = 0.5 * width_ + 0.5;
    for (std::size_t i = 0; i < segments_.size(); ++i) {
        const glm::dvec2 low = glm::min(segments_[i].from, segments_[i].to) - reach,
                         high = glm::max(segments_[i].from, segments_[i].to) + reach;
        const PixelRun columns(low.x, high.x, 0, size_.x), rows(low.y, high.y, 0, size_.y);
        if (columns.begin >= columns.end || rows.begin >= rows.end) continue;
        for (int y = rows.begin / tileSize_; y <= (rows.end - 1) / tileSize_; ++y)
            for (int x = columns.begin / tileSize_; x <= (columns.end - 1) / tileSize_; ++x)
                tiles_[static_cast<std::size_t>(y) * tilesAcross_ + static_cast<std::size_t>(x)].push_back(
                    static_cast<std::uint32_t>(i));
    }
}

std::vector<LineCover> IsolinePixels::inTile(std::size_t tile) const {
    if (tiles_[tile].empty()) return {};
    const int x0 = static_cast<int>(tile % tilesAcross_) * tileSize_,
              y0 = static_cast<int>(tile / tilesAcross_) * tileSize_;
    const double reach = 0.5 * width_ + 0.5;
    const auto count = static_cast<std::size_t>(tileSize_) * static_cast<std::size_t>(tileSize_);
    std::vector<double> nearest(count, std::numeric_limits<double>::infinity());  // distance squared, pixels
    std::vector<LineCover> covers(count);
    for (const std::uint32_t number : tiles_[tile]) {
        const auto& [from, to, value] = segments_[number];
        const glm::dvec2 low = glm::min(from, to) - reach, high = glm::max(from, to) + reach;
        const PixelRun columns(low.x, high.x, x0, x0 + tileSize_), rows(low.y, high.y, y0, y0 + tileSize_);
        for (int y = rows.begin; y < rows.end; ++y)
            for (int x = columns.begin; x < columns.end; ++x) {
                const std::size_t slot = static_cast<std::size_t>(y - y0) * static_cast<std::size_t>(tileSize_) +
                                         static_cast<std::size_t>(x - x0);
                const double found = distance2({x, y}, from, to);
                if (!(found < nearest[slot])) continue;
                nearest[slot] = found;
                covers[slot].value = value;
            }
    }
    for (std::size_t slot = 0; slot < count; ++slot)
        covers[slot].share =
            static_cast<float>(std::clamp(reach - std::sqrt(nearest[slot]), 0.0, std::min(width_, 1.0)));
    return covers;
}

}  // namespace tetralux::projection
