// SPDX-License-Identifier: Apache-2.0
#include <projection/cells/edge_on_planes.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include <glm/geometric.hpp>

namespace tetralux::projection {

namespace {

constexpr std::size_t mostCells = 12000;      // whose faces are looked at
constexpr std::size_t cellStep = 2654435761;  // a prime: cells from everywhere, in no rhythm of a grid
constexpr double quantum = 1e-7;              // planes closer than this, in normals and diagonals, count as one
constexpr std::size_t leastFaces = 3;         // of those looked at, for a plane to count as shared by many
constexpr double edgeOn = 1e-5;               // distance of the eye (diagonals), or sine to the view
constexpr double nearCentre = 4 * 0x1p-14;    // pixels
constexpr double mostPixels = 128.0;          // of a cell, for which the widest shift is needed; less for smaller ones
constexpr double leastShare = 0x1p-6;
constexpr double leastDepth = 0.25;  // diagonals: cells beside the eye are none of the many

using PlaneKey = std::array<std::int64_t, 4>;

struct KeyedPlane {
    PlaneKey key;
    glm::dvec4 plane;
};

/// Nothing (all zero) for a face without area.
KeyedPlane planeOf(const std::array<glm::dvec3, 3>& p) {
    const glm::dvec3 across = glm::cross(p[1] - p[0], p[2] - p[0]);
    const double area = glm::length(across);
    if (!(area > 0)) return {};
    glm::dvec3 normal = across / area;
    const glm::dvec3 size = glm::abs(normal);
    const int largest = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    if (normal[largest] < 0) normal = -normal;
    const glm::dvec4 plane(normal, -glm::dot(normal, p[0]));
    PlaneKey key;
    for (int k = 0; k < 4; ++k) key[static_cast<std::size_t>(k)] = std::llround(plane[k] / quantum);
    return {key, plane};
}

/// Whether the line a + b·x + c·y = 0 passes a pixel centre of the image by less than `nearCentre`.
bool passesPixelCentre(double a, double b, double c, int width, int height) {
    const bool steep = std::abs(b) >= std::abs(c);  // then one pixel of each row is the nearest
    if (!steep) {
        std::swap(b, c);
        std::swap(width, height);
    }
    if (b == 0) return false;
    for (int y = 0; y < height; ++y) {
        const double x = -(a + c * y) / b, nearest = std::round(x);
        if (nearest >= 0 && nearest < width && std::abs(x - nearest) < nearCentre) return true;
    }
    return false;
}

}  // namespace

EdgeOnPlanes::EdgeOnPlanes(const mesh::ScalarMesh& mesh)
    : centre_(mesh.bounds.centre()), perLength_(mesh.bounds.diagonal() > 0 ? 1.0 / mesh.bounds.diagonal() : 1.0) {
    const std::size_t cells = mesh.cells.size(), count = std::min(cells, mostCells);
    std::vector<KeyedPlane> found;
    found.reserve(4 * count);
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t cell = count == cells ? i : i * cellStep % cells;
        for (const auto& face : mesh::faceVertices) {
            std::array<glm::dvec3, 3> p;
            for (std::size_t k = 0; k < 3; ++k)
                p[k] = (mesh.positions[mesh.cells[cell][static_cast<std::size_t>(face[k])]] - centre_) * perLength_;
            for (std::size_t k = 0; k < 3; ++k)
                longestEdge_ = std::max(longestEdge_, glm::distance(p[k], p[(k + 1) % 3]));
            found.push_back(planeOf(p));
        }
    }
    std::sort(found.begin(), found.end(), [](const KeyedPlane& a, const KeyedPlane& b) { return a.key < b.key; });
    for (std::size_t begin = 0, end = 0; begin < found.size(); begin = end) {
        while (end < found.size() && found[end].key == found[begin].key) ++end;
        if (end - begin >= leastFaces && found[begin].key != PlaneKey{}) planes_.push_back(found[begin].plane);
    }
}

glm::dvec2 EdgeOnPlanes::sampleShift(const CameraFrame& frame) const {
    const glm::dvec3 eye = (frame.eye - centre_) * perLength_,
                     right = frame.perPixelRight * (frame.orthographic ? perLength_ : 1.0),
                     down = frame.perPixelDown * (frame.orthographic ? perLength_ : 1.0);
    for (const glm::dvec4& plane : planes_) {
        const glm::dvec3 normal(plane);
        const double atEye = glm::dot(normal, eye) + plane.w, alongView = glm::dot(normal, frame.forward);
        if (std::abs(frame.orthographic ? alongView : atEye) > edgeOn) continue;
        // a plane through the eye, or along the view, is a line of the image
        const double perX = glm::dot(normal, right), perY = glm::dot(normal, down);
        const double atOrigin =
            (frame.orthographic ? atEye : alongView) - frame.centre.x * perX - frame.centre.y * perY;
        if (!passesPixelCentre(atOrigin, perX, perY, frame.width, frame.height)) continue;
        const double depth = frame.orthographic ? 1.0 : glm::length(eye);
        const double pixels = longestEdge_ / (glm::length(right) * std::max(depth, leastDepth));
        return widest * std::clamp(pixels / mostPixels, leastShare, 1.0);
    }
    return barely;
}

CameraFrame sampledFrame(const Camera& camera, const EdgeOnPlanes& planes) {
    CameraFrame frame = cameraFrame(camera);
    frame.sampleShift = planes.sampleShift(frame);
    return frame;
}

}  // namespace tetralux::projection
