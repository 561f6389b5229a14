// SPDX-License-Identifier: Apache-2.0
#include <projection/reference/pixel_candidates.h>

#include <algorithm>
#include <array>
#include <cmath>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <glm/common.hpp>

#include <projection/cells/point_pixel.h>
#include <projection/reference/wanted_pixels.h>

namespace tetralux::projection {

namespace {

/// Pixels by which rectangles grow: floats hold coordinates within the largest image to 1e-3.
constexpr float rounding = 0.01f;
constexpr float farthestPixel = 1e6f;

constexpr std::size_t chunkSize = 8192;  // cells

std::vector<glm::vec2> pixelsOf(const mesh::ScalarMesh& mesh, const CameraFrame& frame) {
    std::vector<glm::vec2> points(mesh.positions.size());
    const PointPixel pixelOf(frame);
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, points.size(), 4096), [&](const auto& range) {
        for (std::size_t i = range.begin(); i != range.end(); ++i) {
            const glm::dvec3 p = mesh.positions[i] - frame.eye;
            const glm::dvec2 at = pixelOf(p, pixelOf.depth(p));
            points[i] = glm::clamp(glm::vec2(at), -farthestPixel, farthestPixel);
        }
    });
    return points;
}

/// The pixels asked for, row by row.
class PixelRows {
public:
    PixelRows(std::span<const std::uint32_t> pixels, const CameraFrame& frame)
        : pixels_(pixels),
          width_(static_cast<std::uint32_t>(frame.width)),
          height_(frame.height),
          blocks_(blocksOf(pixels, frame.width), frame.width / block + 1, frame.height / block + 1),
          rowStart_(static_cast<std::size_t>(frame.height) + 1) {
        for (std::uint32_t pixel : pixels) ++rowStart_[pixel / width_ + 1];
        for (std::size_t y = 1; y < rowStart_.size(); ++y) rowStart_[y] += rowStart_[y - 1];
        if (pixels.size() > few) return;
        for (std::uint32_t pixel : pixels) single_.emplace_back(pixel % width_, pixel / width_);
    }

    /// `visit(i)` for each pixel with low ≤ (x, y) ≤ high.
    template <class Visit>
    void within(const glm::vec2& low, const glm::vec2& high, Visit visit) const {
        if (!single_.empty()) {
            for (std::uint32_t i = 0; i < single_.size(); ++i) {
                const glm::vec2 above = single_[i] - low, below = high - single_[i];
                if (std::min(std::min(above.x, above.y), std::min(below.x, below.y)) >= -rounding) visit(i);
            }
            return;
        }
        const int x0 = first(low.x, static_cast<int>(width_)), y0 = first(low.y, height_);
        const int x1 = end(high.x, static_cast<int>(width_)), y1 = end(high.y, height_);
        if (x0 >= x1 || y0 >= y1) return;
        if (!blocks_.any(x0 / block, y0 / block, (x1 - 1) / block + 1, (y1 - 1) / block + 1))
            return;  // as of most cells
        for (int y = y0; y < y1; ++y) {
            const std::uint32_t row = static_cast<std::uint32_t>(y) * width_;
            const auto begin = pixels_.begin() + rowStart_[static_cast<std::size_t>(y)],
                       stop = pixels_.begin() + rowStart_[static_cast<std::size_t>(y) + 1];
            for (auto at = std::lower_bound(begin, stop, row + static_cast<std::uint32_t>(x0));
                 at != stop && *at < row + static_cast<std::uint32_t>(x1); ++at)
                visit(static_cast<std::uint32_t>(at - pixels_.begin()));
        }
    }

private:
    static constexpr std::size_t few = 6;  // pixels that are asked for one by one sooner than by rows

    static constexpr int block = 8;  // pixels: a table of blocks stays in a processor's nearest cache

    static std::vector<std::uint32_t> blocksOf(std::span<const std::uint32_t> pixels, int width) {
        const auto size = static_cast<std::uint32_t>(block), w = static_cast<std::uint32_t>(width);
        std::vector<std::uint32_t> blocks;
        for (std::uint32_t pixel : pixels) blocks.push_back(pixel / w / size * (w / size + 1) + pixel % w / size);
        return blocks;
    }
    static int first(float low, int limit) {  // the whole number at or above, within 0 … limit
        const float inside = std::clamp(low - rounding, 0.0f, static_cast<float>(limit));
        const int below = static_cast<int>(inside);
        return below + (inside > static_cast<float>(below) ? 1 : 0);
    }
    static int end(float high, int limit) {
        return high + rounding < 0.0f ? 0 : std::min(static_cast<int>(high + rounding) + 1, limit);
    }

    std::span<const std::uint32_t> pixels_;
    std::uint32_t width_;
    int height_;
    WantedPixels blocks_;
    std::vector<std::ptrdiff_t> rowStart_;
    std::vector<glm::vec2> single_;  // where they are few
};

struct Pair {
    std::uint32_t pixel;  ///< its place in the list
    mesh::CellIndex cell;
};

}  // namespace

bool PixelCandidates::possible(const mesh::BoundingBox& bounds, const CameraFrame& frame) {
    if (frame.orthographic) return true;
    const glm::dvec3 half = 0.5 * (bounds.high - bounds.low);
    const double nearest =
        glm::dot(bounds.centre() - frame.eye, frame.forward) - glm::dot(half, glm::abs(frame.forward));
    return nearest > 1e-6 * glm::length(half);
}

PixelCandidates::PixelCandidates(const mesh::ScalarMesh& mesh, const CameraFrame& frame,
                                 std::span<const std::uint32_t> pixels)
    : start_(pixels.size() + 1) {
    const std::vector<glm::vec2> points = pixelsOf(mesh, frame);
    const PixelRows rows(pixels, frame);
    std::vector<std::vector<Pair>> parts(mesh.cells.size() / chunkSize + 1);
    tbb::parallel_for(std::size_t{0}, parts.size(), [&](std::size_t i) {
        const std::size_t end = std::min(mesh.cells.size(), (i + 1) * chunkSize);
        for (std::size_t cell = i * chunkSize; cell < end; ++cell) {
            const auto [a, b, c, d] = mesh.cells[cell];
            const glm::vec2 low = glm::min(glm::min(points[a], points[b]), glm::min(points[c], points[d])),
                            high = glm::max(glm::max(points[a], points[b]), glm::max(points[c], points[d]));
            rows.within(low, high, [&](std::uint32_t pixel) {
                parts[i].push_back({pixel, static_cast<mesh::CellIndex>(cell)});
            });
        }
    });
    for (const auto& part : parts)
        for (const Pair& pair : part) ++start_[pair.pixel + 1];
    for (std::size_t i = 1; i < start_.size(); ++i) start_[i] += start_[i - 1];
    cells_.resize(start_.back());
    std::vector<std::size_t> next(start_.begin(), start_.end() - 1);
    for (const auto& part : parts)
        for (const Pair& pair : part) cells_[next[pair.pixel]++] = pair.cell;
}

}  // namespace tetralux::projection
