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
#include <projection/repair/isosurface_ties.h>
#include <projection/repair/near_line.h>

namespace tetralux::projection {

namespace {

/// Samples beside the centres settle lines upon them as long as floats hold offsets of cells so long (pixels).
constexpr double longestSettled = 128.0;

/// A face's corners before the camera: pixels from the axis times depth (orthographic: pixels), and depth.
struct FaceBeforeEye {
    std::array<glm::dvec3, 3> at;
    bool orthographic;

    /// Whether its image is no higher than edgeOnDistance where it is farthest.
    bool edgeOn() const {
        const glm::dvec3 normal = glm::cross(at[1] - at[0], at[2] - at[0]);
        if (orthographic) {
            const double longest = std::max({glm::length(glm::dvec2(at[1] - at[0])),
                                             glm::length(glm::dvec2(at[2] - at[0])), glm::distance(glm::dvec2(at[1]), glm::dvec2(at[2]))});
            return std::abs(normal.z) <= edgeOnDistance * longest;
        }
        const double deepest = std::max({at[0].z, at[1].z, at[2].z});
        const double slope = glm::length(glm::dvec2(normal));
        return deepest > 0 && std::abs(glm::dot(normal, at[0])) <= edgeOnDistance * slope * deepest;
    }

    /// The part before the eye of the edge that begins at corner i, in pixels from the axis; false where there is none.
    bool edge(std::size_t i, glm::dvec2& begin, glm::dvec2& end) const {
        glm::dvec3 a = at[i], b = at[(i + 1) % 3];
        if (!orthographic) {
            if (a.z > b.z) std::swap(a, b);
            const double least = nearestDepthShare * b.z;
            if (!(b.z > 0)) return false;
            if (a.z < least) a = glm::mix(a, b, (least - a.z) / (b.z - a.z));
        }
        begin = glm::dvec2(a) / (orthographic ? 1.0 : a.z);
        end = glm::dvec2(b) / (orthographic ? 1.0 : b.z);
        return true;
    }
};

/// Whether a face of the cell with corners at these pixels may be edge-on. Corners at or behind the eye have none (NaN):
/// then only a cell that is behind it with all of them has no face to show.
bool mayBeEdgeOn(const glm::vec2& a, const glm::vec2& b, const glm::vec2& c, const glm::vec2& d) {
    const auto area = [](const glm::vec2& u, const glm::vec2& v) { return u.x * v.y - u.y * v.x; };
    const glm::vec2 ab = b - a, ac = c - a, ad = d - a;
    const float abc = area(ab, ac), acd = area(ac, ad), abd = area(ab, ad), bcd = abc + acd - abd;
    const float sum = abc + acd + abd;
    if (std::isnan(sum)) return !std::isnan(a.x) || !std::isnan(b.x) || !std::isnan(c.x) || !std::isnan(d.x);
    const glm::vec2 reach = glm::max(glm::max(glm::abs(ab), glm::abs(ac)), glm::abs(ad));
    const float rounding = edgeOnPixel + edgeOnShare * (std::abs(a.x) + std::abs(a.y) + reach.x + reach.y);
    const float least = std::min(std::min(std::abs(abc), std::abs(acd)), std::min(std::abs(abd), std::abs(bcd)));
    return !(least > rounding * std::max(reach.x, reach.y));
}

/// What add(i, found) appends for every i below `count`, in no order.
template <class Item, class Add>
std::vector<Item> gatheredFrom(std::size_t count, Add add) {
    tbb::enumerable_thread_specific<std::vector<Item>> parts;
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, 4096), [&](const auto& range) {
        auto& part = parts.local();
        for (std::size_t i = range.begin(); i != range.end(); ++i) add(i, part);
    });
    std::vector<Item> all;
    for (const auto& part : parts) all.insert(all.end(), part.begin(), part.end());
    return all;
}

}  // namespace

std::vector<std::uint32_t> edgeOnPixels(const mesh::ScalarMesh& mesh, const CameraFrame& frame,
                                        std::span<const mesh::CellIndex> cells, bool samplesBeside) {
    const double pixel = glm::length(frame.perPixelRight);
    const auto see = [&](mesh::PointIndex point) {
        const glm::dvec3 p = mesh.positions[point] - frame.eye;
        return glm::dvec3(glm::dot(p, frame.right) / pixel, -glm::dot(p, frame.up) / pixel,
                          glm::dot(p, frame.forward));
    };
    const auto addEdges = [&](const FaceBeforeEye& face, std::vector<std::uint32_t>& pixels) {
        for (std::size_t i = 0; i < 3; ++i) {
            glm::dvec2 begin, end;
            if (!face.edge(i, begin, end)) continue;
            const bool settled = samplesBeside && glm::distance(begin, end) < longestSettled;
            addNearLine(frame.centre + begin, frame.centre + end, {settled ? exactTie : 0.0, edgeOnDistance}, frame,
                        pixels);
        }
    };
    return gatheredFrom<std::uint32_t>(cells.size(), [&](std::size_t i, std::vector<std::uint32_t>& pixels) {
        std::array<glm::dvec3, 4> corners;
        for (std::size_t k = 0; k < 4; ++k) corners[k] = see(mesh.cells[cells[i]][k]);
        for (const auto& vertices : mesh::faceVertices) {
            FaceBeforeEye face{{}, frame.orthographic};
            for (std::size_t k = 0; k < 3; ++k) face.at[k] = corners[static_cast<std::size_t>(vertices[k])];
            if (face.edgeOn()) addEdges(face, pixels);
        }
    });
}

std::vector<mesh::CellIndex> cellsSeenEdgeOn(const mesh::ScalarMesh& mesh, const CameraFrame& frame) {
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
    return gatheredFrom<mesh::CellIndex>(mesh.cells.size(), [&](std::size_t i, std::vector<mesh::CellIndex>& found) {
        const auto& [a, b, c, d] = mesh.cells[i];
        if (mayBeEdgeOn(points[a], points[b], points[c], points[d])) found.push_back(static_cast<mesh::CellIndex>(i));
    });
}

}  // namespace tetralux::projection
