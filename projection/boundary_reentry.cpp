// SPDX-License-Identifier: Apache-2.0
#include <projection/boundary_reentry.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>
#include <glm/geometric.hpp>

#include <projection/cell_setup.h>
#include <projection/edge_side.h>

namespace tetralux::projection {

namespace {

std::array<mesh::PointIndex, 3> facePoints(const mesh::ScalarMesh& mesh, const BoundaryFace& face) {
    const auto& local = mesh::faceVertices[static_cast<std::size_t>(face.face)];
    const mesh::Tetrahedron& cell = mesh.cells[face.cell];
    return {cell[static_cast<std::size_t>(local[0])], cell[static_cast<std::size_t>(local[1])],
            cell[static_cast<std::size_t>(local[2])]};
}

/// One boundary edge as one of its faces has it.
struct HalfEdge {
    std::uint64_t key;  // smaller point · 2³² + larger point
    std::uint32_t face;
    mesh::PointIndex opposite;
};

std::vector<HalfEdge> sortedHalfEdges(const mesh::ScalarMesh& mesh, const std::vector<BoundaryFace>& boundary) {
    std::vector<HalfEdge> edges(3 * boundary.size());
    tbb::parallel_for(std::size_t{0}, boundary.size(), [&](std::size_t i) {
        const auto p = facePoints(mesh, boundary[i]);
        for (std::size_t k = 0; k < 3; ++k) {
            const auto [low, high] = std::minmax(p[(k + 1) % 3], p[(k + 2) % 3]);
            edges[3 * i + k] = {std::uint64_t{low} << 32 | high, static_cast<std::uint32_t>(i), p[k]};
        }
    });
    tbb::parallel_sort(edges, [](const HalfEdge& a, const HalfEdge& b) { return a.key < b.key; });
    return edges;
}

/// Whether `point` lies outside of the face's plane by more than rounding.
bool liesOutside(const mesh::ScalarMesh& mesh, const BoundaryFace& face, mesh::PointIndex point) {
    const auto p = facePoints(mesh, face);
    const glm::dvec3 a = mesh.positions[p[0]];
    const glm::dvec3 ab = mesh.positions[p[1]] - a, ac = mesh.positions[p[2]] - a, toPoint = mesh.positions[point] - a;
    const glm::dvec3 normal = glm::cross(ab, ac);
    return glm::dot(normal, toPoint) > 1e-9 * glm::length(normal) * glm::length(toPoint);
}

class DisjointSets {
public:
    explicit DisjointSets(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), 0u); }
    std::uint32_t find(std::uint32_t i) {
        while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
        return i;
    }
    void join(std::uint32_t a, std::uint32_t b) { parent_[find(a)] = find(b); }

private:
    std::vector<std::uint32_t> parent_;
};

}  // namespace

std::vector<BoundaryFace> boundaryFaces(const mesh::Adjacency& adjacency) {
    std::vector<BoundaryFace> faces;
    faces.reserve(adjacency.boundaryFaces);
    for (std::size_t cell = 0; cell < adjacency.neighbours.size(); ++cell)
        for (int k = 0; k < 4; ++k)
            if (adjacency.neighbours[cell][static_cast<std::size_t>(k)] == mesh::Adjacency::noNeighbour)
                faces.push_back({static_cast<mesh::CellIndex>(cell), k});
    return faces;
}

bool boundaryIsConvex(const mesh::ScalarMesh& mesh, const std::vector<BoundaryFace>& boundary) {
    if (boundary.empty()) return false;
    const std::vector<HalfEdge> edges = sortedHalfEdges(mesh, boundary);
    DisjointSets surfaces(boundary.size());
    for (std::size_t i = 0; i < edges.size(); i += 2) {
        // an edge of a closed surface without self-contact has exactly two faces
        if (i + 1 == edges.size() || edges[i].key != edges[i + 1].key) return false;
        if (i + 2 < edges.size() && edges[i + 2].key == edges[i].key) return false;
        if (liesOutside(mesh, boundary[edges[i].face], edges[i + 1].opposite)) return false;
        surfaces.join(edges[i].face, edges[i + 1].face);
    }
    const std::uint32_t first = surfaces.find(0);
    for (std::uint32_t i = 1; i < boundary.size(); ++i)
        if (surfaces.find(i) != first) return false;
    return true;
}

namespace {

/// A ray passes a boundary face.
struct Event {
    double depth;
    mesh::CellIndex cell;
    bool enters;
};

/// A ray that leaves one cell and enters the next within this share of its depth passes straight on: the two sides of a
/// face that is not shared in the data give depths that differ by rounding.
constexpr double coincidence = 1e-9;

/// Boundary faces by rows of pixels, and what the rays of a row meet.
class ReentryScan {
public:
    ReentryScan(const mesh::ScalarMesh& mesh, const std::vector<BoundaryFace>& boundary, const CameraFrame& frame)
        : mesh_(mesh), boundary_(boundary), frame_(frame), points_(mesh.positions.size()) {
        const double pixel = glm::length(frame.perPixelRight);
        tbb::parallel_for(std::size_t{0}, points_.size(), [&](std::size_t i) {
            const glm::dvec3 p = mesh.positions[i] - frame.eye;
            points_[i] = {glm::dot(p, frame.right) / pixel, -glm::dot(p, frame.up) / pixel, glm::dot(p, frame.forward)};
        });
        binFaces();
    }

    Reentry run() {
        tbb::enumerable_thread_specific<Reentry> found;
        tbb::parallel_for(0, bandCount(), [&](int band) { scanBand(band, found.local()); });
        Reentry all;
        for (Reentry& part : found) {
            all.edges.insert(all.edges.end(), part.edges.begin(), part.edges.end());
            all.doubtfulPixels.insert(all.doubtfulPixels.end(), part.doubtfulPixels.begin(), part.doubtfulPixels.end());
        }
        std::sort(all.edges.begin(), all.edges.end());
        all.edges.erase(std::unique(all.edges.begin(), all.edges.end()), all.edges.end());
        std::sort(all.doubtfulPixels.begin(), all.doubtfulPixels.end());
        return all;
    }

private:
    static constexpr int bandRows = 8;

    int bandCount() const { return (frame_.height + bandRows - 1) / bandRows; }

    /// Pixels that a face may cover: exact where all corners are in front of the eye, else the whole image.
    PixelRect rectOf(const BoundaryFace& face) const {
        glm::dvec2 low(1e300), high(-1e300);
        bool front = false, behind = false;
        for (mesh::PointIndex p : facePoints(mesh_, face)) {
            const glm::dvec3& v = points_[p];
            (v.z > 0 ? front : behind) = true;
            const glm::dvec2 at = frame_.orthographic ? glm::dvec2(v.x, v.y) : glm::dvec2(v.x / v.z, v.y / v.z);
            low = glm::min(low, at);
            high = glm::max(high, at);
        }
        if (!front) return {0, 0, 0, 0};
        if (behind && !frame_.orthographic) return {0, 0, frame_.width, frame_.height};
        low += frame_.centre - sampleShift;
        high += frame_.centre - sampleShift;
        auto inside = [](double v, int limit) {
            return static_cast<int>(std::clamp(v, 0.0, static_cast<double>(limit)));
        };
        return {inside(std::ceil(low.x), frame_.width), inside(std::ceil(low.y), frame_.height),
                inside(std::floor(high.x) + 1, frame_.width), inside(std::floor(high.y) + 1, frame_.height)};
    }

    void binFaces() {
        bands_.resize(static_cast<std::size_t>(bandCount()));
        for (std::uint32_t i = 0; i < boundary_.size(); ++i) {
            const PixelRect rect = rectOf(boundary_[i]);
            if (rect.empty()) continue;
            for (int band = rect.y0 / bandRows; band <= (rect.y1 - 1) / bandRows; ++band)
                bands_[static_cast<std::size_t>(band)].push_back({i, rect});
        }
    }

    void scanBand(int band, Reentry& found) const {
        const int y0 = band * bandRows, y1 = std::min(y0 + bandRows, frame_.height);
        std::vector<std::vector<Event>> pixels(static_cast<std::size_t>(frame_.width) *
                                               static_cast<std::size_t>(y1 - y0));
        for (const auto& [face, rect] : bands_[static_cast<std::size_t>(band)])
            for (int y = std::max(rect.y0, y0); y < std::min(rect.y1, y1); ++y)
                for (int x = rect.x0; x < rect.x1; ++x)
                    meet(boundary_[face], x, y,
                         pixels[static_cast<std::size_t>(y - y0) * static_cast<std::size_t>(frame_.width) +
                                static_cast<std::size_t>(x)]);
        for (std::size_t i = 0; i < pixels.size(); ++i)
            if (!pixels[i].empty())
                walk(pixels[i],
                     static_cast<std::uint32_t>(static_cast<std::size_t>(y0) * static_cast<std::size_t>(frame_.width) +
                                                i),
                     found);
    }

    /// Appends where the ray of pixel (x, y) passes the face, by the sides of its edges.
    void meet(const BoundaryFace& face, int x, int y, std::vector<Event>& events) const {
        const auto p = facePoints(mesh_, face);
        const glm::dvec2 at = glm::dvec2(x, y) + sampleShift - frame_.centre;
        std::array<glm::dvec2, 3> q;
        for (std::size_t k = 0; k < 3; ++k) {
            const glm::dvec3& v = points_[p[k]];
            q[k] = glm::dvec2(v) - at * (frame_.orthographic ? 1.0 : v.z);
        }
        std::array<double, 3> w;
        int positive = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            const auto a = (k + 1) % 3, b = (k + 2) % 3;
            w[k] = edgeSide(q[a], q[b]);
            positive += passesPositive(q[a], q[b], p[a], p[b]) ? 1 : 0;
        }
        const double sum = w[0] + w[1] + w[2];
        if ((positive != 0 && positive != 3) || sum == 0) return;
        double depth = 0;
        for (std::size_t k = 0; k < 3; ++k) depth += w[k] / sum * points_[p[k]].z;
        if (depth <= 0) return;
        // camera space is right-handed with the view along z: outside faces the eye where the area is negative
        const bool enters = positive == 0;
        events.push_back({enters ? depth : depth * (1.0 - coincidence), face.cell, enters});
    }

    static void walk(std::vector<Event>& events, std::uint32_t pixel, Reentry& found) {
        std::sort(events.begin(), events.end(), [](const Event& a, const Event& b) {
            return a.depth != b.depth ? a.depth < b.depth : !a.enters && b.enters;
        });
        bool inside = !events.front().enters;  // the eye is in the mesh
        bool clean = true, hasLeft = false;
        mesh::CellIndex lastLeft = 0;
        for (const Event& event : events) {
            clean &= event.enters != inside;
            inside = event.enters;
            if (event.enters) {
                if (hasLeft && lastLeft != event.cell) found.edges.emplace_back(lastLeft, event.cell);
            } else {
                lastLeft = event.cell;
                hasLeft = true;
            }
        }
        if (!clean || inside) found.doubtfulPixels.push_back(pixel);
    }

    const mesh::ScalarMesh& mesh_;
    const std::vector<BoundaryFace>& boundary_;
    const CameraFrame& frame_;
    std::vector<glm::dvec3> points_;
    std::vector<std::vector<std::pair<std::uint32_t, PixelRect>>> bands_;
};

}  // namespace

Reentry findReentry(const mesh::ScalarMesh& mesh, const std::vector<BoundaryFace>& boundary, const CameraFrame& frame) {
    return ReentryScan(mesh, boundary, frame).run();
}

}  // namespace tetralux::projection
