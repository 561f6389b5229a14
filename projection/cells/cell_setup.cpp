// SPDX-License-Identifier: Apache-2.0
#include <projection/cells/cell_setup.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include <glm/geometric.hpp>

#include <mesh/tet/cell_slope.h>
#include <projection/cells/projected_cell.h>

namespace tetralux::projection {

namespace {

using single_cell::CellView, single_cell::CellRect, single_cell::sortedCorners, single_cell::Triple,
    single_cell::viewOf;

Triple tripleOf(const CameraPoint& point) {
    return {point.x, point.y, point.z};
}

/// The corners of a cell in ascending order of their point numbers, and its forms.
struct SortedCell {
    std::array<std::size_t, 4> order;  ///< vertex of the cell at each place
    bool odd;
    Triple corners[4];
    single_cell::CellForms forms;

    SortedCell(const mesh::Tetrahedron& cell, std::span<const CameraPoint> points, bool orthographic) {
        odd = sortedCorners<mesh::PointIndex>(cell, order);
        for (std::size_t place = 0; place < 4; ++place) corners[place] = tripleOf(points[cell[order[place]]]);
        forms = single_cell::cellForms(corners[0], corners[1], corners[2], corners[3], orthographic);
    }
    /// Whether the face opposite to the corner at `place` shows its outside to the eye.
    bool isFront(std::size_t place) const { return (forms.eye[place] < 0) != odd; }
};

}  // namespace

const char* skipReasonName(SkipReason reason) {
    switch (reason) {
        case SkipReason::None:
            return "none";
        case SkipReason::OutsideView:
            return "outside view";
        case SkipReason::NoPixelCentre:
            return "no pixel centre";
        case SkipReason::Invisible:
            return "invisible by transfer function";
    }
    return "";
}

SkipReason coveredPixels(const std::array<glm::dvec3, 4>& v, const CameraFrame& frame, PixelRect& rect) {
    Triple corners[4];
    for (std::size_t k = 0; k < 4; ++k) corners[k] = {v[k].x, v[k].y, v[k].z};
    CellRect covered{};
    const auto reason = static_cast<SkipReason>(single_cell::rectangleOfCell(corners, viewOf(frame), covered));
    if (reason != SkipReason::OutsideView) rect = {covered.x0, covered.y0, covered.x1, covered.y1};
    return reason;
}

CellGradient unitGradient(const mesh::ScalarMesh& mesh, const SceneUnits& units, mesh::CellIndex cell) {
    const mesh::CellSlope slope = mesh::cellSlope(mesh, cell);
    constexpr float least = std::numeric_limits<float>::min();  // what is a gradient in double is one in float
    const auto magnitude = static_cast<float>(slope.magnitude / units.scalarScale * units.length);
    return {
        {static_cast<float>(slope.normal.x), static_cast<float>(slope.normal.y), static_cast<float>(slope.normal.z)},
        slope.any() ? std::max(magnitude, least) : 0.0f};
}

CellProjector::CellProjector(const mesh::ScalarMesh& mesh, const SceneUnits& units, const CameraFrame& frame)
    : mesh_(mesh), units_(units), frame_(frame) {
    projectPoints(mesh, units, frame, ownPoints_);
    points_ = ownPoints_;
}

CellProjector::CellProjector(const mesh::ScalarMesh& mesh, const SceneUnits& units, const CameraFrame& frame,
                             std::span<const CameraPoint> points)
    : mesh_(mesh), units_(units), frame_(frame), points_(points) {}

std::array<glm::dvec3, 4> CellProjector::cameraCorners(mesh::CellIndex cell) const {
    std::array<glm::dvec3, 4> corners;
    for (std::size_t k = 0; k < 4; ++k) {
        const CameraPoint& point = points_[mesh_.cells[cell][k]];
        corners[k] = {point.x, point.y, point.z};
    }
    return corners;
}

SkipReason CellProjector::bounds(mesh::CellIndex cell, PixelRect& rect) const {
    return coveredPixels(cameraCorners(cell), frame_, rect);
}

/// The face is taken in the order of the point numbers, so that its two cells compute the same number.
double CellProjector::eyeSide(mesh::CellIndex cell, int face) const {
    std::array<mesh::PointIndex, 3> p;
    for (std::size_t k = 0; k < 3; ++k)
        p[k] = mesh_.cells[cell][static_cast<std::size_t>(mesh::faceVertices[static_cast<std::size_t>(face)][k])];
    std::array<std::size_t, 3> order;
    const bool odd = sortedCorners(p, order);
    const Triple a = tripleOf(points_[p[order[0]]]), ab = tripleOf(points_[p[order[1]]]) - a,
                 ac = tripleOf(points_[p[order[2]]]) - a;
    const double side = single_cell::faceSide(a, ab, ac, frame_.orthographic);
    return odd ? -side : side;
}

std::array<double, 4> CellProjector::eyeSides(mesh::CellIndex cell) const {
    const SortedCell sorted(mesh_.cells[cell], points_, frame_.orthographic);
    std::array<double, 4> sides;
    for (std::size_t place = 0; place < 4; ++place)
        sides[sorted.order[place]] = sorted.odd ? -sorted.forms.eye[place] : sorted.forms.eye[place];
    return sides;
}

CellRecord CellProjector::record(mesh::CellIndex cell) const {
    const SortedCell sorted(mesh_.cells[cell], points_, frame_.orthographic);
    const CellView view = viewOf(frame_);
    const single_cell::CellReference reference = single_cell::referenceOfCell(sorted.forms, sorted.corners, view);
    double raw[4], s[4];
    for (std::size_t k = 0; k < 4; ++k) {
        raw[k] = mesh_.scalarAt(cell, static_cast<int>(sorted.order[k]));
        s[k] = units_.toUnit(raw[k]);
    }
    const Triple rise = single_cell::sceneRise(single_cell::riseOf(raw), units_.scalarScale);
    const auto projected = single_cell::projectCell(sorted.forms, reference, s, rise, frame_.orthographic);

    std::array<float, sizeof(CellRecord) / sizeof(float)> values;
    int frontMask = 0;
    for (std::size_t place = 0; place < 4; ++place) {
        const std::size_t k = sorted.order[place];
        if (sorted.isFront(place)) frontMask |= 1 << k;
        for (std::size_t j = 0; j < 3; ++j) values[3 * k + j] = static_cast<float>(projected.plane[place][j]);
    }
    for (int i = 12; i < 24; ++i)
        values[static_cast<std::size_t>(i)] =
            static_cast<float>(single_cell::recordValue(i, projected, reference, s, frontMask, view));
    return std::bit_cast<CellRecord>(values);
}

std::array<double, 4> CellProjector::eyeCoordinates(mesh::CellIndex cell) const {
    const SortedCell sorted(mesh_.cells[cell], points_, frame_.orthographic);
    // points are in scene lengths: so are rates
    const double size = std::abs(sorted.forms.determinant) * (frame_.orthographic ? units_.length : 1.0);
    std::array<double, 4> coordinates;
    for (std::size_t place = 0; place < 4; ++place)
        coordinates[sorted.order[place]] =
            (sorted.odd ? -1 : 1) * single_cell::eyeBesideFace(sorted.forms, static_cast<int>(place)) / size;
    return coordinates;
}

}  // namespace tetralux::projection
