// SPDX-License-Identifier: Apache-2.0
#include <projection/cpu_cull.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/geometric.hpp>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <projection/cpu_special_cell.h>

namespace tetralux::projection {

namespace {

/// Pixels beyond this are as far outside as they need to be.
constexpr double farthestPixel = 1e9;

}  // namespace

void projectPoints(const mesh::ScalarMesh& mesh, const SceneUnits& units, const CameraFrame& frame, std::vector<CpuPoint>& points) {
    points.resize(mesh.positions.size());
    const double perLength = 1.0 / units.length, pixel = glm::length(frame.perPixelRight);
    const glm::dvec3 right = frame.right * (frame.orthographic ? 1.0 / pixel : perLength / pixel),
                     down = -frame.up * (frame.orthographic ? 1.0 / pixel : perLength / pixel), forward = frame.forward * perLength;
    const glm::dvec2 centre = frame.centre - sampleShift;
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, points.size(), 4096), [&](const auto& range) {
        for (std::size_t i = range.begin(); i != range.end(); ++i) {
            const glm::dvec3 fromEye = mesh.positions[i] - frame.eye;
            CpuPoint p{glm::dot(fromEye, right), glm::dot(fromEye, down), glm::dot(fromEye, forward), 0, 0};
            const double ratio = frame.orthographic ? 1.0 : 1.0 / p.z;
            if (frame.orthographic || p.z > 0) {
                p.pixelX = static_cast<float>(std::clamp(centre.x + p.x * ratio, -farthestPixel, farthestPixel));
                p.pixelY = static_cast<float>(std::clamp(centre.y + p.y * ratio, -farthestPixel, farthestPixel));
            } else {
                p.pixelX = p.pixelY = std::numeric_limits<float>::quiet_NaN();
            }
            points[i] = p;
        }
    });
}

std::size_t cullCells(const TileFrame& frame, const mesh::CellIndex* visible, std::size_t begin, std::size_t end,
                      Survivor* survivors, CullCounts& counts) {
    const float pad = pixelPadding(frame.width, frame.height);
    std::size_t kept = 0;
    for (std::size_t i = begin; i < end; ++i) {
        const mesh::CellIndex cell = visible ? visible[i] : static_cast<mesh::CellIndex>(i);
        std::array<CpuPoint, 4> p;
        for (std::size_t k = 0; k < 4; ++k) p[k] = frame.points[frame.cells[cell][k]];
        PixelRect rect;
        if (std::isnan(p[0].pixelX + p[1].pixelX + p[2].pixelX + p[3].pixelX)) {
            if (!rectangleAtEye(frame, p, rect)) {
                ++counts.outsideView;
                continue;
            }
        } else {
            const float lowX = std::min({p[0].pixelX, p[1].pixelX, p[2].pixelX, p[3].pixelX}) - pad;
            const float lowY = std::min({p[0].pixelY, p[1].pixelY, p[2].pixelY, p[3].pixelY}) - pad;
            const float highX = std::max({p[0].pixelX, p[1].pixelX, p[2].pixelX, p[3].pixelX}) + pad;
            const float highY = std::max({p[0].pixelY, p[1].pixelY, p[2].pixelY, p[3].pixelY}) + pad;
            const bool behind = frame.orthographic && std::max({p[0].z, p[1].z, p[2].z, p[3].z}) <= 0;
            if (behind || !(highX >= 0 && highY >= 0 && lowX <= static_cast<float>(frame.width - 1) &&
                            lowY <= static_cast<float>(frame.height - 1))) {
                ++counts.outsideView;
                continue;
            }
            rect = {static_cast<int>(std::max(std::ceil(lowX), 0.0f)), static_cast<int>(std::max(std::ceil(lowY), 0.0f)),
                    static_cast<int>(std::min(std::floor(highX) + 1, static_cast<float>(frame.width))),
                    static_cast<int>(std::min(std::floor(highY) + 1, static_cast<float>(frame.height)))};
            if (rect.empty()) {
                ++counts.noPixelCentre;
                continue;
            }
        }
        survivors[kept++] = {0.0, cell, static_cast<std::uint16_t>(rect.x0 / cpuTileSize), static_cast<std::uint16_t>(rect.y0 / cpuTileSize),
                             static_cast<std::uint16_t>((rect.x1 - 1) / cpuTileSize), static_cast<std::uint16_t>((rect.y1 - 1) / cpuTileSize)};
    }
    return kept;
}

}  // namespace tetralux::projection
