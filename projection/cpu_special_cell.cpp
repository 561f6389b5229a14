// SPDX-License-Identifier: Apache-2.0
#include <projection/cpu_special_cell.h>

#include <cmath>
#include <limits>

namespace tetralux::projection {

namespace {

// what the formulas call, for doubles
using std::abs, std::max, std::min;
[[maybe_unused]] double select(bool condition, double ifTrue, double ifFalse) {
    return condition ? ifTrue : ifFalse;
}
double copySign(double magnitude, double sign) {
    return std::copysign(magnitude, sign);
}
#define TETRALUX_CELL_FUNCTION inline
#include <projection/cpu_projected_cell.inl>

/// Depths below this share of the cell's largest depth count as behind the eye.
constexpr double nearestDepthShare = 1e-6;

glm::dvec2 pixelAt(const TileFrame& frame, const glm::dvec3& p) {
    return frame.centre + glm::dvec2(p.x / p.z, p.y / p.z);
}

}  // namespace

bool rectangleAtEye(const TileFrame& frame, const std::array<CpuPoint, 4>& corners, PixelRect& rect) {
    std::array<glm::dvec3, 4> v;
    double deepest = 0;
    for (std::size_t k = 0; k < 4; ++k) {
        v[k] = {corners[k].x, corners[k].y, corners[k].z};
        deepest = std::max(deepest, v[k].z);
    }
    if (!(deepest > 0)) return false;
    const double clip = nearestDepthShare * deepest;
    glm::dvec2 low(std::numeric_limits<double>::infinity()), high(-low.x);
    auto include = [&](const glm::dvec3& point) {
        const glm::dvec2 p = pixelAt(frame, point);
        low = {std::min(low.x, p.x), std::min(low.y, p.y)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y)};
    };
    for (std::size_t k = 0; k < 4; ++k) {
        if (v[k].z >= clip) {
            include(v[k]);
            continue;
        }
        for (std::size_t j = 0; j < 4; ++j)  // where the edge from behind comes to the front
            if (v[j].z > clip) include(v[k] + (clip - v[k].z) / (v[j].z - v[k].z) * (v[j] - v[k]));
    }
    auto begin = [](double x, int limit) {
        return static_cast<int>(std::clamp(std::ceil(x), 0.0, static_cast<double>(limit)));
    };
    auto end = [](double x, int limit) {
        return static_cast<int>(std::clamp(std::floor(x) + 1, 0.0, static_cast<double>(limit)));
    };
    rect = {begin(low.x, frame.width), begin(low.y, frame.height), end(high.x, frame.width), end(high.y, frame.height)};
    return !rect.empty();
}

void setUpCellAtEye(const TileFrame& frame, int tileX, int tileY, const std::int32_t (&points)[4],
                    mesh::CellIndex cellIndex, bool odd, std::size_t j, CellBatch& batch) {
    std::array<CpuPoint, 4> corners;
    bool behind = false;
    for (std::size_t k = 0; k < 4; ++k) {
        corners[k] = frame.points[static_cast<std::uint32_t>(points[k])];
        behind = behind || std::isnan(corners[k].pixelX);
    }
    if (!behind) return;

    PixelRect rect{0, 0, 0, 0};
    const bool covers = rectangleAtEye(frame, corners, rect);
    auto inTile = [](int x, int tile) { return std::clamp(x - tile, 0, cpuTileSize); };
    batch.begin[j][0] = inTile(rect.x0, tileX);
    batch.begin[j][1] = inTile(rect.y0, tileY);
    batch.end[j][0] = covers ? inTile(rect.x1, tileX) : 0;
    batch.end[j][1] = covers ? inTile(rect.y1, tileY) : 0;
    if (!covers) return;

    Triple<double> p[4];
    double s[4], deepest = 0;
    for (std::size_t k = 0; k < 4; ++k) {
        p[k] = {corners[k].x, corners[k].y, corners[k].z};
        s[k] = frame.cellData ? frame.scalars[cellIndex] : frame.scalars[static_cast<std::uint32_t>(points[k])];
        deepest = std::max(deepest, p[k].z);
    }
    const auto forms = cellForms<double, false>(p[0], p[1], p[2], p[3]);
    CellReference<double> reference;
    reference.depth = 0.5 * deepest;
    reference.perDepth = 1.0 / reference.depth;
    reference.imageX = 0.5 * (rect.x0 + rect.x1) - frame.centre.x;
    reference.imageY = 0.5 * (rect.y0 + rect.y1) - frame.centre.y;
    coordinatesAt<double, false>(forms, reference);
    const auto cell = projectCell<double, false>(forms, reference, s);
    std::uint32_t fronts = 0;
    for (std::size_t k = 0; k < 4; ++k) {
        fronts |= (forms.eye[k] < 0) != odd ? 1u << k : 0u;  // as the plane's sign was taken, also where it is 0
        for (std::size_t i = 0; i < 3; ++i) batch.plane[k][i][j] = static_cast<float>(cell.plane[k][i]);
    }
    batch.frontMask[j] = fronts;
    batch.scalar[j] = static_cast<float>(cell.scalar);
    batch.scalarPerX[j] = static_cast<float>(cell.scalarPerX);
    batch.scalarPerY[j] = static_cast<float>(cell.scalarPerY);
    batch.scalarPerRho[j] = static_cast<float>(cell.scalarPerRho);
    batch.scale[j] = static_cast<float>(reference.depth);
    batch.offsetX[j] = static_cast<float>(tileX - frame.centre.x - reference.imageX);
    batch.offsetY[j] = static_cast<float>(tileY - frame.centre.y - reference.imageY);
    const auto depths =
        depthBounds<double, false>(frame.depthReference, reference.depth, reference.perDepth, deepest, deepest);
    batch.rhoNear[j] = static_cast<float>(largestRho);
    batch.rhoFar[j] = static_cast<float>(depths.rhoFar - 1e-6);
    batch.nearness[j] = static_cast<float>(depths.nearness);
    batch.nearnessPerRho[j] = static_cast<float>(depths.nearnessPerRho);
    batch.nearnessChecked[j] = static_cast<float>(depths.nearness - frame.orderTolerance - depths.rounding);
    // in scene lengths, as (right, down, forward)
    const double gx = cell.gradient.x / frame.pixel, gy = cell.gradient.y / frame.pixel, gz = cell.gradient.z;
    const double magnitude = std::sqrt(gx * gx + gy * gy + gz * gz), scale = magnitude > 0 ? 1.0 / magnitude : 0.0;
    batch.normal[0][j] = static_cast<float>(gx * scale);
    batch.normal[1][j] = static_cast<float>(gy * scale);
    batch.normal[2][j] = static_cast<float>(gz * scale);
    batch.gradient[j] = static_cast<float>(magnitude);
    for (std::size_t k = 0; k < 4; ++k) {
        batch.eyeWeight[k][j] = static_cast<float>(forms.eye[k] / forms.determinant);
        batch.corner[k][j] = points[k];
    }
}

}  // namespace tetralux::projection
