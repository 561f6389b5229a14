// SPDX-License-Identifier: Apache-2.0
#include <projection/cpu/cpu_special_cell.h>

#include <algorithm>
#include <cmath>

#include <projection/cells/projected_cell.h>

namespace tetralux::projection {

using namespace single_cell;

void takeRowsOfCells(const TileFrame& frame, std::span<const TileEntry> entries, std::size_t cells, CellBatch& batch) {
    for (std::size_t j = 0; j < cells; ++j) {
        const mesh::Tetrahedron &points = frame.cells[entries[j].cell],
                                &rows = frame.vertexLight->corners[entries[j].cell];
        for (auto& corner : batch.corner) {
            const auto at = std::find(points.begin(), points.end(), static_cast<mesh::PointIndex>(corner[j]));
            corner[j] = static_cast<std::int32_t>(rows[static_cast<std::size_t>(at - points.begin()) % 4]);
        }
    }
}

/// Cells about the eye reach far over the image, near it in some places and far from it in others.
static void keepInDouble(const ProjectedCell& cell, double offsetX, double offsetY, std::size_t j, SteepCells& steep) {
    steep.is[j] = 1.0f;
    for (std::size_t k = 0; k < 4; ++k)
        for (std::size_t i = 0; i < 3; ++i) steep.plane[k][i][j] = cell.plane[k][i];
    steep.offsetX[j] = offsetX;
    steep.offsetY[j] = offsetY;
    steep.scalar[j] = cell.scalar;
    steep.scalarPerX[j] = cell.scalarPerX;
    steep.scalarPerY[j] = cell.scalarPerY;
    steep.scalarPerInverseDepth[j] = cell.scalarPerInverseDepth;
}

bool rectangleAtEye(const TileFrame& frame, const std::array<CameraPoint, 4>& corners, PixelRect& rect) {
    std::array<glm::dvec3, 4> points;
    for (std::size_t k = 0; k < 4; ++k) points[k] = {corners[k].x, corners[k].y, corners[k].z};
    return coveredPixels(points, *frame.camera, rect) == SkipReason::None;
}

void setUpCellAtEye(const TileFrame& frame, int tileX, int tileY, const std::int32_t (&points)[4],
                    mesh::CellIndex cellIndex, bool odd, std::size_t j, CellBatch& batch) {
    std::array<CameraPoint, 4> corners;
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

    Triple p[4];
    double s[4], raw[4], deepest = 0;
    for (std::size_t k = 0; k < 4; ++k) {
        p[k] = Triple(corners[k].x, corners[k].y, corners[k].z);
        const std::size_t at = frame.cellData ? cellIndex : static_cast<std::uint32_t>(points[k]);
        s[k] = frame.scalars[at];
        raw[k] = frame.fieldScalars[at];
        deepest = std::max(deepest, p[k].z);
    }
    const auto forms = cellForms(p[0], p[1], p[2], p[3], false);
    CellReference reference;
    reference.depth = 0.5 * deepest;
    reference.perDepth = 1.0 / reference.depth;
    reference.imageX = 0.5 * (rect.x0 + rect.x1) - frame.centre.x;
    reference.imageY = 0.5 * (rect.y0 + rect.y1) - frame.centre.y;
    coordinatesAt(forms, reference);
    const auto cell = projectCell(forms, reference, s, sceneRise(riseOf(raw), frame.scalarScale), false);
    std::uint32_t fronts = 0;
    for (std::size_t k = 0; k < 4; ++k) {
        fronts |= (forms.eye[k] < 0) != odd ? 1u << k : 0u;  // as the plane's sign was taken, also where it is 0
        for (std::size_t i = 0; i < 3; ++i) batch.plane[k][i][j] = static_cast<float>(cell.plane[k][i]);
    }
    batch.frontMask[j] = fronts;
    keepInDouble(cell, tileX - frame.centre.x - reference.imageX, tileY - frame.centre.y - reference.imageY, j,
                 batch.steep);
    batch.scalar[j] = static_cast<float>(cell.scalar);
    batch.scalarPerX[j] = static_cast<float>(cell.scalarPerX);
    batch.scalarPerY[j] = static_cast<float>(cell.scalarPerY);
    batch.scalarPerInverseDepth[j] = static_cast<float>(cell.scalarPerInverseDepth);
    batch.scale[j] = static_cast<float>(reference.depth);
    batch.offsetX[j] = static_cast<float>(tileX - frame.centre.x - reference.imageX);
    batch.offsetY[j] = static_cast<float>(tileY - frame.centre.y - reference.imageY);
    batch.restX[j] = batch.restY[j] = 0.0f;
    const auto depths = depthBounds(frame.depthReference, reference.depth, reference.perDepth, deepest, deepest, false);
    batch.inverseDepthNear[j] = static_cast<float>(largestInverseDepth);
    batch.inverseDepthFar[j] = static_cast<float>(depths.inverseDepthFar - 1e-6);
    batch.rayInverseDepth[j] = static_cast<float>(depths.rayInverseDepth);
    batch.rayPerInverseDepth[j] = static_cast<float>(depths.rayPerInverseDepth);
    batch.rayInverseDepthChecked[j] =
        static_cast<float>(depths.rayInverseDepth - frame.orderTolerance - depths.rounding);
    // in scene lengths, as (right, down, forward)
    const double gx = cell.gradient.x / frame.pixel, gz = cell.gradient.z,
                 gy = (cell.gradient.y - frame.rowLean * cell.gradient.x) / (frame.pixel * frame.rowStretch);
    const double magnitude = std::sqrt(gx * gx + gy * gy + gz * gz), scale = magnitude > 0 ? 1.0 / magnitude : 0.0;
    batch.normal[0][j] = static_cast<float>(gx * scale);
    batch.normal[1][j] = static_cast<float>(gy * scale);
    batch.normal[2][j] = static_cast<float>(gz * scale);
    batch.gradient[j] = static_cast<float>(magnitude > 0 ? std::max(magnitude, leastFloatGradient) : 0.0);
    for (std::size_t k = 0; k < 4; ++k) {
        batch.eyeWeight[k][j] = static_cast<float>(eyeBesideFace(forms, static_cast<int>(k)) / forms.determinant);
        batch.corner[k][j] = points[k];
    }
}

}  // namespace tetralux::projection
