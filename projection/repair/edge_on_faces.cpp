// SPDX-License-Identifier: Apache-2.0
#include <projection/repair/edge_on_faces.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <projection/cells/cell_constants.h>
#include <projection/cells/edge_on_planes.h>
#include <projection/cells/point_pixel.h>
#include <projection/repair/cell_measures.h>

namespace tetralux::projection {

namespace {

constexpr double largestError = 5e-5;    // of opacity
constexpr double ofReach = 0x1p-23;      // rounding of offsets and planes: a share of a cell's extent in the image
constexpr double ofReference = 0x1p-38;  // pixels: what double makes of the reference's rays
/// Of candidates, by their pixels in float: what a face is high at most, in pixels, per pixel that samples stand aside,
/// and as a share of the cell's extent; and the rounding of its corners, as a share of their coordinates.
constexpr float lowestPixels = 1e-3f, shareOfReach = 0x1p-6f, shareOfPlace = 1e-6f;
constexpr double perShift = 4e4;
constexpr double mostOblique = 16.0;  // by which silhouettes multiply depth (float_limits.cpp)

/// Part of a face's image, convex, in pixels: from its corners, or from what of it lies before the eye and in view.
class SeenFace {
public:
    void add(const glm::dvec2& corner) {
        if (count_ < at_.size()) at_[count_++] = corner;
    }

    /// Leaves what lies on one side of a line x[axis] = place.
    void clip(int axis, double place, double sign) {
        SeenFace rest;
        for (std::size_t i = 0; i < count_; ++i) {
            const glm::dvec2 &a = at_[i], &b = at_[(i + 1) % count_];
            const double fromA = sign * (a[axis] - place), fromB = sign * (b[axis] - place);
            if (fromA >= 0) rest.add(a);
            if ((fromA >= 0) != (fromB >= 0)) rest.add(glm::mix(a, b, fromA / (fromA - fromB)));
        }
        *this = rest;
    }

    bool empty() const { return count_ == 0; }
    double low(int axis) const { return extreme(axis, 1); }
    double high(int axis) const { return -extreme(axis, -1); }

    /// Where the line x[axis] = place meets it: from x to y along the other axis. Beside it: as at its nearest corner.
    glm::dvec2 across(int axis, double place) const {
        place = std::clamp(place, low(axis), high(axis));
        const int other = 1 - axis;
        glm::dvec2 found(std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity());
        for (std::size_t i = 0; i < count_; ++i) {
            glm::dvec2 a = at_[i], b = at_[(i + 1) % count_];
            if (a[axis] > b[axis]) std::swap(a, b);  // an edge that two faces share gives both the same
            if (place < a[axis] || place > b[axis]) continue;
            const double length = b[axis] - a[axis];
            const double share = length > 0 ? (place - a[axis]) / length : 0.0;
            const double value = a[other] + share * (b[other] - a[other]);
            found = {std::min(found.x, value), std::max(found.y, value)};
            if (!(length > 0)) found = {std::min(found.x, b[other]), std::max(found.y, b[other])};
        }
        return found;
    }

private:
    double extreme(int axis, double sign) const {
        double least = std::numeric_limits<double>::infinity();
        for (std::size_t i = 0; i < count_; ++i) least = std::min(least, sign * at_[i][axis]);
        return least;
    }

    std::array<glm::dvec2, 12> at_;
    std::size_t count_ = 0;
};

/// One face before the camera: corners in pixels from the axis times depth (orthographic: pixels), and depth.
class FaceBeforeEye {
public:
    FaceBeforeEye(const std::array<glm::dvec3, 3>& corners, const CameraFrame& frame)
        : at_(corners),
          normal_(glm::cross(corners[1] - corners[0], corners[2] - corners[0])),
          perDepth_(std::hypot(normal_.x, normal_.y)),
          fromEye_(std::abs(frame.orthographic ? normal_.z : glm::dot(normal_, corners[0]))),
          nearest_(std::min({corners[0].z, corners[1].z, corners[2].z})),
          deepest_(std::max({corners[0].z, corners[1].z, corners[2].z})),
          frame_(frame) {}

    /// How much deeper the plane is one pixel farther, mesh units: at the face's far end, where it is most.
    double steepest() const { return frame_.orthographic ? perDepth_ / fromEye_ : slopeAt(deepest_); }
    double slope(const glm::dvec2& pixel) const {
        if (frame_.orthographic) return steepest();
        const glm::dvec2 fromAxis = pixel - frame_.centre;
        const double along = std::abs(normal_.x * fromAxis.x + normal_.y * fromAxis.y + normal_.z);
        return slopeAt(std::clamp(along > 0 ? fromEye_ / along : deepest_, std::max(nearest_, 0.0), deepest_));
    }

    bool before() const { return deepest_ > 0 || frame_.orthographic; }

    SeenFace seen() const {
        SeenFace face;
        const double least = nearestDepthShare * deepest_;
        for (std::size_t i = 0; i < 3; ++i) {
            const glm::dvec3 &a = at_[i], &b = at_[(i + 1) % 3];
            const bool aBefore = frame_.orthographic || a.z >= least, bBefore = frame_.orthographic || b.z >= least;
            if (aBefore) face.add(image(a));
            if (aBefore != bBefore) face.add(image(glm::mix(a, b, (a.z - least) / (a.z - b.z))));
        }
        const glm::dvec2 last(frame_.width, frame_.height);
        for (int axis = 0; axis < 2; ++axis) {
            if (!face.empty() && face.low(axis) < -1.0) face.clip(axis, -1.0, 1.0);
            if (!face.empty() && face.high(axis) > last[axis]) face.clip(axis, last[axis], -1.0);
        }
        return face;
    }

private:
    double slopeAt(double depth) const { return depth * depth * perDepth_ / fromEye_; }
    glm::dvec2 image(const glm::dvec3& p) const {
        return frame_.centre + glm::dvec2(p) / (frame_.orthographic ? 1.0 : p.z);
    }

    const std::array<glm::dvec3, 3> at_;
    const glm::dvec3 normal_;
    const double perDepth_, fromEye_, nearest_, deepest_;
    const CameraFrame& frame_;
};

/// The pixels of one face.
class FacePixels {
public:
    FacePixels(const FaceBeforeEye& face, const CameraFrame& frame, double rounding, double visiblePerLength)
        : plane_(face), frame_(frame), rounding_(rounding), visiblePerLength_(visiblePerLength) {}

    void add(std::vector<std::uint32_t>& pixels) const {
        const SeenFace face = plane_.seen();
        if (face.empty()) return;
        const int axis = face.high(1) - face.low(1) >= face.high(0) - face.low(0) ? 1 : 0, other = 1 - axis;
        const std::array size{frame_.width, frame_.height};
        const auto count = [&](int a) { return static_cast<double>(size[static_cast<std::size_t>(a)]); };
        const glm::dvec2 sample = frame_.sampleShift, ray = EdgeOnPlanes::barely;
        const double reach = rounding_ + sample[axis];
        const double first = std::max(std::ceil(face.low(axis) - reach), 0.0),
                     last = std::min(std::floor(face.high(axis) + reach), count(axis) - 1.0);
        for (double row = first; row <= last; ++row) {
            const glm::dvec2 bySample = face.across(axis, row + sample[axis]) - sample[other],
                             byRay = face.across(axis, row + ray[axis]) - ray[other];
            const double low = std::min(bySample.x - rounding_, byRay.x - ofReference),
                         high = std::max(bySample.y + rounding_, byRay.y + ofReference);
            for (double column = std::max(std::ceil(low), 0.0); column <= std::min(high, count(other) - 1.0); ++column)
                if (differs(column, bySample, byRay) &&
                    shows(axis == 1 ? glm::dvec2(column, row) : glm::dvec2(row, column)))
                    pixels.push_back(static_cast<std::uint32_t>(axis == 1 ? row : column) *
                                         static_cast<std::uint32_t>(frame_.width) +
                                     static_cast<std::uint32_t>(axis == 1 ? column : row));
        }
    }

private:
    /// Not where sample and ray pass the face on one side, clearly.
    bool differs(double column, const glm::dvec2& bySample, const glm::dvec2& byRay) const {
        return !(column < bySample.x - rounding_ && column < byRay.x - ofReference) &&
               !(column > bySample.y + rounding_ && column > byRay.y + ofReference);
    }
    bool shows(const glm::dvec2& pixel) const {
        const double aside = rounding_ + std::max(frame_.sampleShift.x, frame_.sampleShift.y);
        return visiblePerLength_ * plane_.slope(pixel) * aside > largestError;
    }

    const FaceBeforeEye& plane_;
    const CameraFrame& frame_;
    const double rounding_, visiblePerLength_;
};

/// Whether a face of the cell with corners at these pixels may be that low. Corners at or behind the eye have none
/// (NaN): then only a cell that is behind it with all of them has no face to show.
bool mayBeEdgeOn(const glm::vec2& a, const glm::vec2& b, const glm::vec2& c, const glm::vec2& d, float lowest) {
    const auto area = [](const glm::vec2& u, const glm::vec2& v) { return u.x * v.y - u.y * v.x; };
    const glm::vec2 ab = b - a, ac = c - a, ad = d - a;
    const float abc = area(ab, ac), acd = area(ac, ad), abd = area(ab, ad), bcd = abc + acd - abd;
    const float sum = abc + acd + abd;
    if (std::isnan(sum)) return !std::isnan(a.x) || !std::isnan(b.x) || !std::isnan(c.x) || !std::isnan(d.x);
    const glm::vec2 sides = glm::max(glm::max(glm::abs(ab), glm::abs(ac)), glm::abs(ad));
    const float reach = std::max(sides.x, sides.y);
    const float height = lowest + shareOfPlace * (std::abs(a.x) + std::abs(a.y)) + shareOfReach * reach;
    const float least = std::min(std::min(std::abs(abc), std::abs(acd)), std::min(std::abs(abd), std::abs(bcd)));
    return !(least > height * reach);
}

/// What add(i, found) appends for every i below `count`, in no order.
template <class Item, class Add>
std::vector<Item> gatheredFrom(std::size_t count, Add add) {
    tbb::enumerable_thread_specific<std::vector<Item>> parts;
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, 1024), [&](const auto& range) {
        auto& part = parts.local();
        for (std::size_t i = range.begin(); i != range.end(); ++i) add(i, part);
    });
    std::vector<Item> all;
    for (const auto& part : parts) all.insert(all.end(), part.begin(), part.end());
    return all;
}

}  // namespace

EdgeOnFaces::EdgeOnFaces(const Scene& scene) : scene_(scene) {
    const Mode mode = scene.settings.mode;
    anythingShows_ = mode == Mode::FirstHit || mode == Mode::Depth || mode == Mode::Mip || mode == Mode::Minimum ||
                     mode == Mode::Average || scene.settings.contributions.perCell;
}

/// How much opacity, or how much of what counts in its place, a ray gathers in the cell per length at most.
double EdgeOnFaces::visiblePerLength(mesh::CellIndex cell) const {
    const mesh::ScalarMesh& mesh = *scene_.mesh;
    const bool standard = integralOf(scene_.settings.mode) == preint::Integral::Standard;
    const double oblique = scene_.settings.shading.silhouette ? mostOblique : 1.0;
    const CellScalars scalars = scalarsOf(mesh, cell);
    const double extinction = anythingShows_ ? 0.0 : extinctionsOf(scene_.transferFunction, scalars).most;
    if (!anythingShows_ && standard) return extinction * oblique;
    const CellShape shape = shapeOf(mesh, cell);
    if (!(shape.leastAltitude > 0)) return std::numeric_limits<double>::infinity();
    return (anythingShows_ ? 1.0 : extinction * scalars.width()) / shape.leastAltitude;
}

std::vector<std::uint32_t> EdgeOnFaces::pixels(const CameraFrame& frame, std::span<const mesh::CellIndex> cells) const {
    const mesh::ScalarMesh& mesh = *scene_.mesh;
    const double pixel = frame.pixel, image = std::max(frame.width, frame.height);
    const auto see = [&](mesh::PointIndex point) {
        const glm::dvec3 p = mesh.positions[point] - frame.eye;
        return glm::dvec3(glm::dot(p, frame.columnAxis) / pixel, glm::dot(p, frame.rowAxis) / pixel,
                          glm::dot(p, frame.forward));
    };
    const auto reachOf = [&](const std::array<glm::dvec3, 4>& corners) {
        glm::dvec2 low(image), high(-image);
        for (const glm::dvec3& p : corners) {
            if (!frame.orthographic && !(p.z > 0)) return image;
            const glm::dvec2 at = glm::dvec2(p) / (frame.orthographic ? 1.0 : p.z);
            low = glm::min(low, at);
            high = glm::max(high, at);
        }
        return std::clamp(std::max(high.x - low.x, high.y - low.y), 1.0, image);
    };
    return gatheredFrom<std::uint32_t>(cells.size(), [&](std::size_t i, std::vector<std::uint32_t>& found) {
        std::array<glm::dvec3, 4> corners;
        for (std::size_t k = 0; k < 4; ++k) corners[k] = see(mesh.cells[cells[i]][k]);
        const double rounding = ofReach * reachOf(corners), aside = rounding + frame.sampleShift.x;
        double perLength = -1;
        for (const auto& vertices : mesh::faceVertices) {
            std::array<glm::dvec3, 3> at;
            for (std::size_t k = 0; k < 3; ++k) at[k] = corners[static_cast<std::size_t>(vertices[k])];
            const FaceBeforeEye face(at, frame);
            if (!face.before()) continue;
            if (perLength < 0) perLength = visiblePerLength(cells[i]);
            if (!(perLength * face.steepest() * aside <= largestError))
                FacePixels(face, frame, rounding, perLength).add(found);
        }
    });
}

std::vector<mesh::CellIndex> EdgeOnFaces::candidates(const CameraFrame& frame) const {
    const mesh::ScalarMesh& mesh = *scene_.mesh;
    std::vector<glm::vec2> points(mesh.positions.size());
    const PointPixel pixelOf(frame);
    constexpr float none = std::numeric_limits<float>::quiet_NaN();
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, points.size(), 4096), [&](const auto& range) {
        for (std::size_t i = range.begin(); i != range.end(); ++i) {
            const glm::dvec3 p = mesh.positions[i] - frame.eye;
            const double depth = pixelOf.depth(p);
            points[i] = frame.orthographic || depth > 0 ? glm::vec2(pixelOf(p, depth)) : glm::vec2(none);
        }
    });
    const float lowest = lowestPixels + static_cast<float>(perShift * frame.sampleShift.x);
    return gatheredFrom<mesh::CellIndex>(mesh.cells.size(), [&](std::size_t i, std::vector<mesh::CellIndex>& found) {
        const auto& [a, b, c, d] = mesh.cells[i];
        if (mayBeEdgeOn(points[a], points[b], points[c], points[d], lowest))
            found.push_back(static_cast<mesh::CellIndex>(i));
    });
}

}  // namespace tetralux::projection
