// SPDX-License-Identifier: Apache-2.0
#include <projection/cell_setup.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <projection/projected_cell.h>

namespace tetralux::projection {

namespace {

using single_cell::sortedCorners, single_cell::Triple;

/// Depths below this share of the cell's largest depth count as behind the eye.
constexpr double nearestDepthShare = 1e-6;

/// Cells with all depths above this share of the largest are described about their centroid.
constexpr double centroidDepthShare = 0.1;

glm::dvec2 pixelOf(const CameraFrame& frame, const glm::dvec3& point) {
    if (frame.orthographic) return sampleCentre(frame) + glm::dvec2(point.x, point.y);
    return sampleCentre(frame) + glm::dvec2(point.x / point.z, point.y / point.z);
}

Triple<double> tripleOf(const CameraPoint& point) {
    return {point.x, point.y, point.z};
}

/// The corners of a cell in ascending order of their point numbers, and its forms.
template <bool Orthographic>
struct SortedCell {
    std::array<std::size_t, 4> order;  ///< vertex of the cell at each place
    bool odd;
    single_cell::CellForms<double> forms;

    SortedCell(const mesh::Tetrahedron& cell, std::span<const CameraPoint> points) {
        odd = sortedCorners<mesh::PointIndex>(cell, order);
        auto corner = [&](std::size_t place) { return tripleOf(points[cell[order[place]]]); };
        forms = single_cell::cellForms<double, Orthographic>(corner(0), corner(1), corner(2), corner(3));
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
    const double deepest = std::max({v[0].z, v[1].z, v[2].z, v[3].z}),
                 nearest = std::min({v[0].z, v[1].z, v[2].z, v[3].z});
    if (!(deepest > 0)) return SkipReason::OutsideView;

    glm::dvec2 low(std::numeric_limits<double>::infinity()), high(-low.x);
    auto include = [&](const glm::dvec2& p) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    };
    const double clip = frame.orthographic ? nearest : nearestDepthShare * deepest;
    for (std::size_t k = 0; k < 4; ++k) {
        if (v[k].z >= clip) {
            include(pixelOf(frame, v[k]));
            continue;
        }
        for (std::size_t j = 0; j < 4; ++j)  // where the edge from behind comes to the front
            if (v[j].z > clip) include(pixelOf(frame, glm::mix(v[k], v[j], (clip - v[k].z) / (v[j].z - v[k].z))));
    }
    if (!(high.x >= 0 && high.y >= 0 && low.x <= frame.width - 1 && low.y <= frame.height - 1))
        return SkipReason::OutsideView;
    auto clampTo = [](double value, int limit) { return std::clamp(value, 0.0, static_cast<double>(limit)); };
    rect.x0 = static_cast<int>(clampTo(std::ceil(low.x), frame.width));
    rect.y0 = static_cast<int>(clampTo(std::ceil(low.y), frame.height));
    rect.x1 = static_cast<int>(clampTo(std::floor(high.x) + 1, frame.width));
    rect.y1 = static_cast<int>(clampTo(std::floor(high.y) + 1, frame.height));
    return rect.empty() ? SkipReason::NoPixelCentre : SkipReason::None;
}

CellProjector::CellProjector(const mesh::ScalarMesh& mesh, const SceneUnits& units, const CameraFrame& frame)
    : mesh_(mesh), units_(units), frame_(frame) {
    projectPoints(mesh, units, frame, ownPoints_);
    points_ = ownPoints_;
}

CellProjector::CellProjector(const mesh::ScalarMesh& mesh, const SceneUnits& units, const CameraFrame& frame,
                             std::span<const CameraPoint> points)
    : mesh_(mesh), units_(units), frame_(frame), points_(points) {}

std::array<glm::dvec3, 4> CellProjector::cornersOf(mesh::CellIndex cell) const {
    std::array<glm::dvec3, 4> corners;
    for (std::size_t k = 0; k < 4; ++k) {
        const CameraPoint& point = points_[mesh_.cells[cell][k]];
        corners[k] = {point.x, point.y, point.z};
    }
    return corners;
}

SkipReason CellProjector::bounds(mesh::CellIndex cell, PixelRect& rect) const {
    return coveredPixels(cornersOf(cell), frame_, rect);
}

std::optional<std::array<glm::dvec2, 4>> CellProjector::corners(mesh::CellIndex cell) const {
    const std::array<glm::dvec3, 4> points = cornersOf(cell);
    const double deepest = std::max({points[0].z, points[1].z, points[2].z, points[3].z});
    std::array<glm::dvec2, 4> result;
    for (std::size_t k = 0; k < 4; ++k) {
        if (!frame_.orthographic && !(deepest > 0 && points[k].z >= nearestDepthShare * deepest)) return std::nullopt;
        result[k] = pixelOf(frame_, points[k]);
    }
    return result;
}

/// The face is taken in the order of the point numbers, so that its two cells compute the same number.
double CellProjector::eyeSide(mesh::CellIndex cell, int face) const {
    std::array<mesh::PointIndex, 3> p;
    for (std::size_t k = 0; k < 3; ++k)
        p[k] = mesh_.cells[cell][static_cast<std::size_t>(mesh::faceVertices[static_cast<std::size_t>(face)][k])];
    std::array<std::size_t, 3> order;
    const bool odd = sortedCorners(p, order);
    const Triple<double> a = tripleOf(points_[p[order[0]]]), ab = tripleOf(points_[p[order[1]]]) - a,
                         ac = tripleOf(points_[p[order[2]]]) - a;
    const double side = frame_.orthographic ? single_cell::faceSide<double, true>(a, ab, ac)
                                            : single_cell::faceSide<double, false>(a, ab, ac);
    return odd ? -side : side;
}

template <bool Orthographic>
std::array<double, 4> CellProjector::eyeSidesIn(mesh::CellIndex cell) const {
    const SortedCell<Orthographic> sorted(mesh_.cells[cell], points_);
    std::array<double, 4> sides;
    for (std::size_t place = 0; place < 4; ++place)
        sides[sorted.order[place]] = sorted.odd ? -sorted.forms.eye[place] : sorted.forms.eye[place];
    return sides;
}

std::array<double, 4> CellProjector::eyeSides(mesh::CellIndex cell) const {
    return frame_.orthographic ? eyeSidesIn<true>(cell) : eyeSidesIn<false>(cell);
}

template <bool Orthographic>
CellRecord CellProjector::recordIn(mesh::CellIndex cell) const {
    const SortedCell<Orthographic> sorted(mesh_.cells[cell], points_);
    const auto& forms = sorted.forms;
    const double deepest = forms.a.z + std::max({0.0, forms.ab.z, forms.ac.z, forms.ad.z}),
                 nearest = forms.a.z + std::min({0.0, forms.ab.z, forms.ac.z, forms.ad.z});
    const glm::dvec2 centre = sampleCentre(frame_);
    single_cell::CellReference<double> reference;
    if (Orthographic || nearest > centroidDepthShare * deepest) {
        reference = single_cell::centroidReference<double, Orthographic>(forms);
    } else {
        PixelRect rect{};
        bounds(cell, rect);
        reference = {0.5 * (rect.x0 + rect.x1) - centre.x,
                     0.5 * (rect.y0 + rect.y1) - centre.y,
                     0.5 * deepest,
                     1.0 / (0.5 * deepest),
                     {}};
        single_cell::coordinatesAt<double, Orthographic>(forms, reference);
    }
    double s[4];
    for (std::size_t k = 0; k < 4; ++k) s[k] = units_.toUnit(mesh_.scalarAt(cell, static_cast<int>(sorted.order[k])));
    const auto projected = single_cell::projectCell<double, Orthographic>(forms, reference, s);

    CellRecord record;
    int frontMask = 0;
    for (std::size_t place = 0; place < 4; ++place) {
        const std::size_t k = sorted.order[place];
        if (sorted.isFront(place)) frontMask |= 1 << k;
        for (std::size_t j = 0; j < 3; ++j) record.plane[k][j] = static_cast<float>(projected.plane[place][j]);
    }
    record.frontMask = static_cast<float>(frontMask);
    record.scalar = static_cast<float>(projected.scalar);
    record.scalarPerX = static_cast<float>(projected.scalarPerX);
    record.scalarPerY = static_cast<float>(projected.scalarPerY);
    record.scalarPerRho = static_cast<float>(projected.scalarPerRho);
    record.scalarLow = static_cast<float>(std::min({s[0], s[1], s[2], s[3]}));
    record.scalarHigh = static_cast<float>(std::max({s[0], s[1], s[2], s[3]}));
    record.scale = static_cast<float>(reference.depth);

    const glm::dvec2 pixel = centre + glm::dvec2(reference.imageX, reference.imageY);
    record.pixelX = static_cast<float>(std::round(pixel.x));
    record.pixelY = static_cast<float>(std::round(pixel.y));
    record.fractionX = static_cast<float>(pixel.x - std::round(pixel.x));
    record.fractionY = static_cast<float>(pixel.y - std::round(pixel.y));
    return record;
}

CellRecord CellProjector::record(mesh::CellIndex cell) const {
    return frame_.orthographic ? recordIn<true>(cell) : recordIn<false>(cell);
}

template <bool Orthographic>
std::array<double, 4> CellProjector::eyeCoordinatesIn(mesh::CellIndex cell) const {
    const SortedCell<Orthographic> sorted(mesh_.cells[cell], points_);
    // points are in scene lengths: so are rates
    const double size = std::abs(sorted.forms.determinant) * (Orthographic ? units_.length : 1.0);
    std::array<double, 4> coordinates;
    for (std::size_t place = 0; place < 4; ++place)
        coordinates[sorted.order[place]] = (sorted.odd ? -1 : 1) * sorted.forms.eye[place] / size;
    return coordinates;
}

std::array<double, 4> CellProjector::eyeCoordinates(mesh::CellIndex cell) const {
    return frame_.orthographic ? eyeCoordinatesIn<true>(cell) : eyeCoordinatesIn<false>(cell);
}

CellGradient CellProjector::gradient(mesh::CellIndex cell) const {
    // in scene units first: |g|² of a mesh of size 1e-15 leaves the range of double otherwise
    const glm::dvec3 g = mesh::cellGradient(mesh_, cell) / units_.scalarScale * units_.length;
    const double magnitude = glm::length(g);
    const glm::dvec3 normal = magnitude > 0 ? g / magnitude : glm::dvec3(0);
    return {{static_cast<float>(normal.x), static_cast<float>(normal.y), static_cast<float>(normal.z)},
            static_cast<float>(magnitude)};
}

}  // namespace tetralux::projection
