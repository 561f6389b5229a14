// SPDX-License-Identifier: Apache-2.0
#include <projection/visibility_order.h>

#include <algorithm>
#include <limits>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>
#include <glm/geometric.hpp>

#include <projection/boundary_reentry.h>
#include <projection/cell_setup.h>
#include <projection/power_order.h>

namespace tetralux::projection {

struct VisibilitySorter::State {
    const mesh::ScalarMesh& mesh;
    std::string method;
    OrderKeys keys;
    std::uint64_t failingFaces = 0;
    mesh::Adjacency adjacency;
    std::vector<BoundaryFace> boundary;  // empty when it is convex: nothing to look for

    State(const mesh::ScalarMesh& m, OrderMethod wanted, Use use) : mesh(m) {
        if (wanted == OrderMethod::Centroid) {
            method = "centroid";
            keys = OrderKeys::centroid(mesh);
            return;
        }
        adjacency = mesh::buildAdjacency(m.cells, m.positions.size());
        boundary = boundaryFaces(adjacency);
        const bool convex =
            adjacency.nonManifoldFaces == 0 && adjacency.foldedFaces == 0 && boundaryIsConvex(mesh, boundary);
        method = convex ? "mpvo" : "mpvo+reentry";
        if (!convex) return;
        boundary = {};
        if (wanted == OrderMethod::Graph || use == Use::Whole) return;
        const PowerOrder power(mesh, adjacency);
        failingFaces = power.failingFaces();
        if (failingFaces > 0) return;
        method = "power";
        keys = OrderKeys::power(mesh, power.heights());
        adjacency = {};
    }
};

VisibilitySorter::VisibilitySorter(const mesh::ScalarMesh& mesh, OrderMethod method, Use use)
    : state_(std::make_unique<State>(mesh, method, use)) {}
VisibilitySorter::~VisibilitySorter() = default;

const std::string& VisibilitySorter::method() const {
    return state_->method;
}
const OrderKeys& VisibilitySorter::keys() const {
    return state_->keys;
}
std::uint64_t VisibilitySorter::failingFaces() const {
    return state_->failingFaces;
}

namespace {

/// The relation "lies in front of" between cells: across shared faces, and across gaps of a nonconvex boundary.
class VisibilityGraph {
public:
    VisibilityGraph(const mesh::Adjacency& adjacency, const CellProjector& projector,
                    const std::vector<std::pair<mesh::CellIndex, mesh::CellIndex>>& reentry)
        : adjacency_(adjacency),
          reentry_(reentry),
          frontFaces_(adjacency.neighbours.size()),
          nearer_(adjacency.neighbours.size()) {
        tbb::parallel_for(std::size_t{0}, frontFaces_.size(), [&](std::size_t i) {
            const auto cell = static_cast<mesh::CellIndex>(i);
            unsigned mask = 0, count = 0;
            for (unsigned k = 0; k < 4; ++k) {
                if (!projector.faceIsFront(cell, static_cast<int>(k))) continue;
                mask |= 1u << k;
                count += adjacency_.neighbours[i][k] != mesh::Adjacency::noNeighbour ? 1u : 0u;
            }
            frontFaces_[i] = static_cast<std::uint8_t>(mask);
            nearer_[i] = count;
        });
        for (const auto& [near, far] : reentry_) ++nearer_[far];
    }

    std::size_t size() const { return nearer_.size(); }
    bool isFree(mesh::CellIndex cell) const { return nearer_[cell] == 0; }

    /// Takes `cell` out of the graph and calls `freed` for each cell that nothing unordered lies in front of any more.
    template <class Freed>
    void remove(mesh::CellIndex cell, Freed freed) {
        auto release = [&](mesh::CellIndex other) {
            if (nearer_[other] > 0 && --nearer_[other] == 0) freed(other);
        };
        for (std::size_t k = 0; k < 4; ++k) {
            const mesh::CellIndex other = adjacency_.neighbours[cell][k];
            // seen edge-on the face is in front for neither cell: no relation
            if (other != mesh::Adjacency::noNeighbour && !(frontFaces_[cell] >> k & 1u) && looksBackAt(other, cell))
                release(other);
        }
        auto range = std::equal_range(reentry_.begin(), reentry_.end(), std::pair{cell, mesh::CellIndex{0}},
                                      [](const auto& a, const auto& b) { return a.first < b.first; });
        for (auto edge = range.first; edge != range.second; ++edge) release(edge->second);
    }

    /// No cell in front of this one holds it back any more: used to break a cycle.
    void force(mesh::CellIndex cell) { nearer_[cell] = 0; }

private:
    /// Whether `cell` has the face that it shares with `neighbour` as a front face.
    bool looksBackAt(mesh::CellIndex cell, mesh::CellIndex neighbour) const {
        for (std::size_t k = 0; k < 4; ++k)
            if (adjacency_.neighbours[cell][k] == neighbour && frontFaces_[cell] >> k & 1u) return true;
        return false;
    }

    const mesh::Adjacency& adjacency_;
    const std::vector<std::pair<mesh::CellIndex, mesh::CellIndex>>& reentry_;
    std::vector<std::uint8_t> frontFaces_;
    std::vector<std::uint32_t> nearer_;  // how many unordered cells lie directly in front
};

std::vector<mesh::CellIndex> sortedByKeys(const OrderKeys& keys, const CameraFrame& frame) {
    const std::vector<glm::dvec4>& planes = keys.planes();
    const glm::dvec4 eye = keys.eye(frame);
    using Range = tbb::blocked_range<std::size_t>;
    struct Extent {
        double far = std::numeric_limits<double>::infinity(), near = -far;
    };
    const Extent extent = tbb::parallel_reduce(
        Range(0, planes.size(), 8192), Extent{},
        [&](const Range& range, Extent e) {
            for (std::size_t i = range.begin(); i != range.end(); ++i) {
                const double key = orderKey(planes[i], eye);
                e = {std::min(e.far, key), std::max(e.near, key)};
            }
            return e;
        },
        [](const Extent& a, const Extent& b) {
            return Extent{std::min(a.far, b.far), std::max(a.near, b.near)};
        });
    std::vector<KeyedCell> cells(planes.size()), scratch;
    tbb::parallel_for(Range(0, planes.size(), 8192), [&](const Range& range) {
        for (std::size_t i = range.begin(); i != range.end(); ++i)
            cells[i] = {orderedKey(orderKey(planes[i], eye), extent.near, extent.far), static_cast<std::uint32_t>(i)};
    });
    radixSort(cells, scratch);
    std::vector<mesh::CellIndex> order(cells.size());
    std::transform(cells.begin(), cells.end(), order.begin(), [](const KeyedCell& c) { return c.cell; });
    return order;
}

double distanceOf(const mesh::ScalarMesh& mesh, const CameraFrame& frame, mesh::CellIndex cell) {
    glm::dvec3 sum(0);
    for (mesh::PointIndex p : mesh.cells[cell]) sum += mesh.positions[p] - frame.eye;
    return frame.orthographic ? glm::dot(sum, frame.forward) : glm::length(sum);
}

}  // namespace

/// Williams' MPVO as a topological sort over the graph (Kahn), nearest first. Where only cycles are left the nearest
/// remaining cell is taken out of turn; that can be wrong only in the pixels that it covers, and those are named.
VisibilityOrder VisibilitySorter::sort(const CameraFrame& frame) const {
    const mesh::ScalarMesh& mesh = state_->mesh;
    VisibilityOrder order;
    order.method = state_->method;
    if (state_->method == "centroid") {
        order.frontToBack = sortedByKeys(state_->keys, frame);
        return order;
    }
    const CellProjector projector(mesh, sceneUnits(mesh), frame);
    Reentry reentry;
    if (!state_->boundary.empty()) reentry = findReentry(mesh, state_->boundary, frame);
    order.doubtfulPixels = std::move(reentry.doubtfulPixels);

    VisibilityGraph graph(state_->adjacency, projector, reentry.edges);
    std::vector<mesh::CellIndex>& sorted = order.frontToBack;
    sorted.reserve(graph.size());
    std::vector<bool> taken(graph.size());
    auto take = [&](mesh::CellIndex cell) {
        taken[cell] = true;
        sorted.push_back(cell);
    };
    for (mesh::CellIndex cell = 0; cell < graph.size(); ++cell)
        if (graph.isFree(cell)) take(cell);

    std::size_t done = 0;
    auto drain = [&] {
        while (done < sorted.size()) graph.remove(sorted[done++], [&](mesh::CellIndex cell) { take(cell); });
    };
    drain();
    if (sorted.size() < graph.size()) {
        std::vector<std::pair<double, mesh::CellIndex>> remaining;
        for (mesh::CellIndex cell = 0; cell < graph.size(); ++cell)
            if (!taken[cell]) remaining.emplace_back(distanceOf(mesh, frame, cell), cell);
        std::sort(remaining.begin(), remaining.end());
        std::vector<bool> doubtful(static_cast<std::size_t>(frame.width) * static_cast<std::size_t>(frame.height));
        for (std::uint32_t pixel : order.doubtfulPixels) doubtful[pixel] = true;
        for (const auto& [distance, cell] : remaining) {
            if (taken[cell]) continue;
            ++order.cyclicCells;
            PixelRect rect;
            if (projector.bounds(cell, rect) == SkipReason::None)
                for (int y = rect.y0; y < rect.y1; ++y)
                    for (int x = rect.x0; x < rect.x1; ++x)
                        doubtful[static_cast<std::size_t>(y) * static_cast<std::size_t>(frame.width) +
                                 static_cast<std::size_t>(x)] = true;
            graph.force(cell);
            take(cell);
            drain();
        }
        order.doubtfulPixels.clear();
        for (std::uint32_t pixel = 0; pixel < doubtful.size(); ++pixel)
            if (doubtful[pixel]) order.doubtfulPixels.push_back(pixel);
    }
    return order;
}

}  // namespace tetralux::projection
