// SPDX-License-Identifier: Apache-2.0
#include <projection/order/boundary_reentry.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <projection/cells/cell_setup.h>
#include <projection/cells/edge_side.h>

namespace tetralux::projection {

namespace {

using Corners = std::array<mesh::PointIndex, 3>;

Corners cornersOf(const mesh::Tetrahedron& cell, std::size_t face) {
    const auto& local = mesh::faceVertices[face];
    return {cell[static_cast<std::size_t>(local[0])], cell[static_cast<std::size_t>(local[1])],
            cell[static_cast<std::size_t>(local[2])]};
}

/// One boundary edge as one of its faces has it.
struct HalfEdge {
    std::uint64_t key;  // smaller point · 2³² + larger point
    std::uint32_t face;
    mesh::PointIndex opposite;
};

std::vector<HalfEdge> sortedHalfEdges(const std::vector<BoundaryFace>& boundary) {
    std::vector<HalfEdge> edges(3 * boundary.size());
    tbb::parallel_for(std::size_t{0}, boundary.size(), [&](std::size_t i) {
        const Corners& p = boundary[i].corners;
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
    const Corners& p = face.corners;
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

std::vector<BoundaryFace> boundaryFaces(const mesh::ScalarMesh& mesh, const mesh::Adjacency& adjacency) {
    std::vector<BoundaryFace> faces;
    faces.reserve(adjacency.boundaryFaces);
    for (std::size_t cell = 0; cell < adjacency.neighbours.size(); ++cell)
        for (std::size_t k = 0; k < 4; ++k)
            if (adjacency.neighbours[cell][k] == mesh::Adjacency::noNeighbour)
                faces.push_back({static_cast<mesh::CellIndex>(cell), cornersOf(mesh.cells[cell], k)});
    return faces;
}

bool boundaryIsConvex(const mesh::ScalarMesh& mesh, const std::vector<BoundaryFace>& boundary) {
    if (boundary.empty()) return false;
    const std::vector<HalfEdge> edges = sortedHalfEdges(boundary);
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

struct PixelEvent {
    Event event;
    std::uint32_t pixel;  // of the band
};

/// A ray that leaves one cell and enters the next within this share of its depth passes straight on: the two sides of a
/// face that is not shared in the data give depths that differ by rounding.
constexpr double coincidence = 1e-9;

/// Boundary faces by rows of pixels, and what the rays of a row meet.
class ReentryScan {
public:
    ReentryScan(const mesh::ScalarMesh& mesh, const std::vector<BoundaryFace>& boundary, const CameraFrame& frame,
                std::span<const CameraPoint> points)
        : mesh_(mesh), boundary_(boundary), frame_(frame), points_(points) {
        binFaces();
    }

    Reentry run() {
        tbb::enumerable_thread_specific<Reentry> found;
        tbb::enumerable_thread_specific<BandEvents> events;
        tbb::parallel_for(0, bandCount(), [&](int band) { scanBand(band, events.local(), found.local()); });
        Reentry all;
        for (Reentry& part : found) {
            all.edges.insert(all.edges.end(), part.edges.begin(), part.edges.end());
            all.uncertainPixels.insert(all.uncertainPixels.end(), part.uncertainPixels.begin(),
                                       part.uncertainPixels.end());
        }
        tbb::parallel_sort(all.edges.begin(), all.edges.end());
        all.edges.erase(std::unique(all.edges.begin(), all.edges.end()), all.edges.end());
        std::sort(all.uncertainPixels.begin(), all.uncertainPixels.end());
        return all;
    }

private:
    static constexpr int bandRows = 8;

    int bandCount() const { return (frame_.height + bandRows - 1) / bandRows; }

    /// Pixels that a face may cover: exact where all corners are in front of the eye, else the whole image.
    PixelRect rectOf(const BoundaryFace& face) const {
        glm::dvec2 low(1e300), high(-1e300);
        bool front = false, behind = false;
        for (mesh::PointIndex p : face.corners) {
            const CameraPoint& v = points_[p];
            (v.z > 0 ? front : behind) = true;
            const glm::dvec2 at = frame_.orthographic ? glm::dvec2(v.x, v.y) : glm::dvec2(v.x / v.z, v.y / v.z);
            low = glm::min(low, at);
            high = glm::max(high, at);
        }
        if (!front) return {0, 0, 0, 0};
        if (behind && !frame_.orthographic) return {0, 0, frame_.width, frame_.height};
        low += sampleCentre(frame_);
        high += sampleCentre(frame_);
        auto inside = [](double v, int limit) {
            return static_cast<int>(std::clamp(v, 0.0, static_cast<double>(limit)));
        };
        return {inside(std::ceil(low.x), frame_.width), inside(std::ceil(low.y), frame_.height),
                inside(std::floor(high.x) + 1, frame_.width), inside(std::floor(high.y) + 1, frame_.height)};
    }

    void binFaces() {
        bands_.resize(static_cast<std::size_t>(bandCount()));
        std::vector<PixelRect> rects(boundary_.size());
        tbb::parallel_for(tbb::blocked_range<std::size_t>(0, rects.size(), 2048), [&](const auto& range) {
            for (std::size_t i = range.begin(); i != range.end(); ++i) rects[i] = rectOf(boundary_[i]);
        });
        for (std::uint32_t i = 0; i < boundary_.size(); ++i) {
            const PixelRect& rect = rects[i];
            if (rect.empty()) continue;
            for (int band = rect.y0 / bandRows; band <= (rect.y1 - 1) / bandRows; ++band)
                bands_[static_cast<std::size_t>(band)].push_back({i, rect});
        }
    }

    /// What the rays of a band meet, pixel by pixel; kept from band to band for its memory.
    struct BandEvents {
        std::vector<PixelEvent> met;
        std::vector<std::uint32_t> start;  // per pixel of the band, and the end
        std::vector<Event> sorted;
    };

    void scanBand(int band, BandEvents& events, Reentry& found) const {
        const int y0 = band * bandRows, y1 = std::min(y0 + bandRows, frame_.height);
        events.met.clear();
        for (const auto& [face, rect] : bands_[static_cast<std::size_t>(band)])
            meet(boundary_[face], rect, y0, y1, events.met);
        if (events.met.empty()) return;

        const auto pixelCount = static_cast<std::size_t>(frame_.width) * static_cast<std::size_t>(y1 - y0);
        events.start.assign(pixelCount + 1, 0);
        for (const PixelEvent& e : events.met) ++events.start[e.pixel + 1];
        std::partial_sum(events.start.begin(), events.start.end(), events.start.begin());
        events.sorted.resize(events.met.size());
        for (const PixelEvent& e : events.met) events.sorted[events.start[e.pixel]++] = e.event;
        const auto first = static_cast<std::uint32_t>(y0) * static_cast<std::uint32_t>(frame_.width);
        std::uint32_t begin = 0;
        for (std::uint32_t pixel = 0; pixel < pixelCount; ++pixel) {
            const std::uint32_t end = events.start[pixel];  // filling moved it to where the pixel's events end
            if (end > begin) walk(events.sorted.data() + begin, events.sorted.data() + end, first + pixel, found);
            begin = end;
        }
    }

    /// The side of an edge, linear in the pixel: (a − p·a.z) × (b − p·b.z) = a × b − p × (a.z·b − b.z·a). Taken in the
    /// order of the point numbers, so that both faces of an edge get the same number to the bit, and about a pixel near
    /// the edge, so that nothing cancels where faces are small.
    struct EdgeForm {
        glm::dvec2 origin, rate;
        double constant;

        double inRow(double y) const { return constant + rate.y * (y - origin.y); }
        double at(double x, double ofRow) const { return ofRow + rate.x * (x - origin.x); }
    };

    EdgeForm sideOf(mesh::PointIndex from, mesh::PointIndex to) const {
        const bool ascending = from < to;
        const CameraPoint& first = points_[ascending ? from : to];
        glm::dvec3 a = first.position(), b = points_[ascending ? to : from].position();
        if (frame_.orthographic) a.z = b.z = 1.0;
        EdgeForm form;
        form.origin = a.z > 0 ? glm::dvec2(first.pixelX, first.pixelY) - sampleCentre(frame_) : glm::dvec2(0);
        const glm::dvec2 p = glm::dvec2(a) - form.origin * a.z, q = glm::dvec2(b) - form.origin * b.z;
        const double sign = ascending ? 1.0 : -1.0;
        form.constant = sign * edgeSide(p, q);
        form.rate = sign * glm::dvec2(p.y * b.z - q.y * a.z, q.x * a.z - p.x * b.z);
        return form;
    }

    /// Appends where rays of the rows [y0, y1) pass the face, by the sides of its edges.
    void meet(const BoundaryFace& face, const PixelRect& rect, int y0, int y1, std::vector<PixelEvent>& met) const {
        const Corners& p = face.corners;
        const std::array side{sideOf(p[1], p[2]), sideOf(p[2], p[0]), sideOf(p[0], p[1])};
        const glm::dvec3 depths(points_[p[0]].z, points_[p[1]].z, points_[p[2]].z);
        const glm::dvec2 shift = -sampleCentre(frame_);
        for (int y = std::max(rect.y0, y0); y < std::min(rect.y1, y1); ++y) {
            const double atY = y + shift.y;
            const std::array row{side[0].inRow(atY), side[1].inRow(atY), side[2].inRow(atY)};
            for (int x = rect.x0; x < rect.x1; ++x) {
                const double atX = x + shift.x;
                const glm::dvec3 w(side[0].at(atX, row[0]), side[1].at(atX, row[1]), side[2].at(atX, row[2]));
                const double least = std::min({w.x, w.y, w.z}), most = std::max({w.x, w.y, w.z});
                if (least < 0 && most > 0) continue;
                const int positive = least > 0 ? 3 : most < 0 ? 0 : settledSides(p, {atX, atY}, w);
                const double sum = w.x + w.y + w.z;
                if ((positive != 0 && positive != 3) || sum == 0) continue;
                const double depth = glm::dot(w, depths) / sum;
                if (depth <= 0) continue;
                // camera space is right-handed with the view along z: outside faces the eye where the area is negative
                const bool enters = positive == 0;
                met.push_back({{enters ? depth : depth * (1.0 - coincidence), face.cell, enters},
                               static_cast<std::uint32_t>((y - y0) * frame_.width + x)});
            }
        }
    }

    /// How many of the three sides count as positive where some are exactly zero.
    int settledSides(const std::array<mesh::PointIndex, 3>& p, const glm::dvec2& at, const glm::dvec3& w) const {
        std::array<glm::dvec2, 3> q;
        for (std::size_t k = 0; k < 3; ++k)
            q[k] = glm::dvec2(points_[p[k]].position()) - at * (frame_.orthographic ? 1.0 : points_[p[k]].z);
        int positive = 0;
        for (int k = 0; k < 3; ++k) {
            const auto a = static_cast<std::size_t>((k + 1) % 3), b = static_cast<std::size_t>((k + 2) % 3);
            positive += w[k] > 0 || (w[k] == 0 && zeroSideIsPositive(q[a], q[b], p[a], p[b])) ? 1 : 0;
        }
        return positive;
    }

    /// Where the ray of a pixel comes into a cell; infinity where it does not meet it.
    double entryDepth(mesh::CellIndex cell, std::uint32_t pixel) const {
        const auto width = static_cast<std::uint32_t>(frame_.width);
        const glm::dvec2 at = glm::dvec2(pixel % width, pixel / width) - sampleCentre(frame_);
        double nearest = std::numeric_limits<double>::infinity();
        for (std::size_t face = 0; face < 4; ++face) {
            const Corners p = cornersOf(mesh_.cells[cell], face);
            const auto side = [&](std::size_t from, std::size_t to) {
                const EdgeForm form = sideOf(p[from], p[to]);
                return form.at(at.x, form.inRow(at.y));
            };
            const glm::dvec3 w(side(1, 2), side(2, 0), side(0, 1));
            const glm::dvec3 depths(points_[p[0]].z, points_[p[1]].z, points_[p[2]].z);
            const double sum = w.x + w.y + w.z;
            if (sum != 0 && w.x * sum >= 0 && w.y * sum >= 0 && w.z * sum >= 0)
                nearest = std::min(nearest, glm::dot(w, depths) / sum);
        }
        return nearest;
    }

    /// Whether a ray that comes into a second cell before it has left the first is composed right in their order. Cells
    /// that reach into one another are composed one after the other, the one that is met first in front: so it is
    /// where the mesh reaches into itself by less than the last cell's path.
    bool followsInTurn(const Event& entry, const Event& leave, std::uint32_t pixel) const {
        return !leave.enters && leave.cell != entry.cell && entryDepth(leave.cell, pixel) < entry.depth;
    }

    void walk(Event* begin, Event* end, std::uint32_t pixel, Reentry& found) const {
        std::sort(begin, end, [](const Event& a, const Event& b) {
            return a.depth != b.depth ? a.depth < b.depth : !a.enters && b.enters;
        });
        bool inside = !begin->enters;  // the eye is in the mesh
        bool clean = true, hasLeft = false;
        mesh::CellIndex lastLeft = 0;
        for (Event* at = begin; at != end; ++at) {
            if (inside && at->enters && at + 1 != end && followsInTurn(at[0], at[1], pixel)) std::swap(at[0], at[1]);
            const Event& event = *at;
            clean &= event.enters != inside;
            inside = event.enters;
            if (event.enters) {
                const std::pair edge{lastLeft, event.cell};
                // most pixels tell what their neighbour told
                if (hasLeft && lastLeft != event.cell && (found.edges.empty() || found.edges.back() != edge))
                    found.edges.push_back(edge);
            } else {
                lastLeft = event.cell;
                hasLeft = true;
            }
        }
        if (!clean || inside) found.uncertainPixels.push_back(pixel);
    }

    const mesh::ScalarMesh& mesh_;
    const std::vector<BoundaryFace>& boundary_;
    const CameraFrame& frame_;
    std::span<const CameraPoint> points_;
    std::vector<std::vector<std::pair<std::uint32_t, PixelRect>>> bands_;
};

}  // namespace

Reentry findReentry(const mesh::ScalarMesh& mesh, const std::vector<BoundaryFace>& boundary, const CameraFrame& frame,
                    std::span<const CameraPoint> points) {
    return ReentryScan(mesh, boundary, frame, points).run();
}

}  // namespace tetralux::projection
