// SPDX-License-Identifier: Apache-2.0
#include <projection/order/visibility_order.h>

#include <algorithm>
#include <memory>
#include <numeric>
#include <optional>
#include <string>
#include <utility>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <glm/geometric.hpp>

#include <projection/cells/cell_setup.h>
#include <projection/order/boundary_reentry.h>
#include <projection/order/incremental_sort.h>
#include <projection/order/key_sort.h>
#include <projection/order/power_order.h>
#include <projection/order/visibility_relations.h>

namespace tetralux::projection {

namespace {

/// What the order of any view stands on; of points and cells alone.
struct MeshOrder {
    std::string method;
    OrderKeys keys;
    std::uint64_t failingFaces = 0;
    mesh::Adjacency adjacency;
    RoundedPlanes planes;
    std::vector<BoundaryFace> boundary;  // empty when it is convex: nothing to look for

    MeshOrder(const mesh::ScalarMesh& mesh, OrderMethod wanted, VisibilitySorter::Use use) {
        if (wanted == OrderMethod::Centroid) {
            method = "centroid";
            keys = OrderKeys::centroid(mesh);
            return;
        }
        adjacency = mesh::buildAdjacency(mesh.cells, mesh.positions.size());
        boundary = boundaryFaces(mesh, adjacency);
        const bool convex =
            adjacency.nonManifoldFaces == 0 && adjacency.foldedFaces == 0 && boundaryIsConvex(mesh, boundary);
        if (convex) boundary = {};
        method = convex ? "mpvo" : "mpvo+reentry";
        if (convex && wanted != OrderMethod::Graph) {
            const PowerOrder power(mesh, adjacency);
            failingFaces = power.failingFaces();
            if (failingFaces == 0) {
                method = "power";
                keys = OrderKeys::power(mesh, power.heights());
                if (use == VisibilitySorter::Use::Keys) adjacency = {};
            }
        }
        if (!adjacency.neighbours.empty()) planes = RoundedPlanes(mesh);
    }
};

std::shared_ptr<const MeshOrder> orderOf(const mesh::ScalarMesh& mesh, OrderMethod method, VisibilitySorter::Use use,
                                         MeshMemo* memo) {
    const auto make = [&] { return MeshOrder(mesh, method, use); };
    if (memo == nullptr) return std::make_shared<const MeshOrder>(make());
    const std::string name =
        "order " + std::to_string(static_cast<int>(method)) + std::to_string(static_cast<int>(use));
    return memo->get<MeshOrder>(name, make);
}

}  // namespace

struct VisibilitySorter::State {
    const mesh::ScalarMesh& mesh;
    MeshMemo* const memo;
    const std::shared_ptr<const MeshOrder> order;
    std::shared_ptr<const MeshOrder> connected = order;  // whose adjacency the relations are those of
    std::optional<VisibilityRelations> relations;
    std::vector<std::uint32_t> nearer;
    VisibilityOrder last;
    std::optional<CameraFrame> lastFrame;

    void findOrder(const CellProjector& projector);
    void seeGaps(const CellProjector& projector);

    State(const mesh::ScalarMesh& m, OrderMethod method, Use use, MeshMemo* kept)
        : mesh(m), memo(kept), order(orderOf(m, method, use, kept)) {
        relations.emplace(order->adjacency, order->planes);
        last.method = order->method;
    }

    /// Of an order that needs no relations, to hold it against them all the same.
    void connect() {
        if (!connected->adjacency.neighbours.empty()) return;
        connected = orderOf(mesh, OrderMethod::Graph, Use::Whole, memo);
        relations.emplace(connected->adjacency, connected->planes);
    }
};

VisibilitySorter::VisibilitySorter(const mesh::ScalarMesh& mesh, OrderMethod method, Use use, MeshMemo* memo)
    : state_(std::make_unique<State>(mesh, method, use, memo)) {}
VisibilitySorter::~VisibilitySorter() = default;
VisibilitySorter::VisibilitySorter(VisibilitySorter&&) noexcept = default;
VisibilitySorter& VisibilitySorter::operator=(VisibilitySorter&&) noexcept = default;

const std::string& VisibilitySorter::method() const {
    return state_->order->method;
}
const OrderKeys& VisibilitySorter::keys() const {
    return state_->order->keys;
}
const mesh::Adjacency& VisibilitySorter::adjacency() const {
    return state_->order->adjacency;
}
std::uint64_t VisibilitySorter::failingFaces() const {
    return state_->order->failingFaces;
}

void VisibilitySorter::takeOver(VisibilitySorter&& previous) {
    if (previous.state_->order != state_->order) return;
    state_->last = std::move(previous.state_->last);
    state_->lastFrame = previous.state_->lastFrame;
}

namespace {

std::vector<mesh::CellIndex> sortedByKeys(const OrderKeys& keys, const CameraFrame& frame) {
    std::vector<mesh::CellIndex> order(keys.planes().size());
    std::iota(order.begin(), order.end(), mesh::CellIndex{0});
    KeySorter().sort(keys, keys.eye(frame), order);
    return order;
}

double distanceOf(const mesh::ScalarMesh& mesh, const CameraFrame& frame, mesh::CellIndex cell) {
    glm::dvec3 sum(0);
    for (mesh::PointIndex p : mesh.cells[cell]) sum += mesh.positions[p] - frame.eye;
    return frame.orthographic ? glm::dot(sum, frame.forward) : glm::length(sum);
}

/// Williams' MPVO as a topological sort (Kahn), nearest first. Where only cycles are left the nearest remaining cell is
/// taken out of turn: `cyclicCells` counts those. `nearer` is memory kept from call to call.
void sortByRelations(const VisibilityRelations& relations, const mesh::ScalarMesh& mesh, const CameraFrame& frame,
                     std::vector<std::uint32_t>& nearer, VisibilityOrder& order) {
    constexpr std::size_t ahead = 12;  // cells whose neighbours come into the cache while others are looked at
    const std::size_t count = relations.cellCount();
    nearer.resize(count);  // how many unordered cells lie directly in front
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, 8192), [&](const auto& range) {
        for (std::size_t i = range.begin(); i != range.end(); ++i)
            nearer[i] = relations.countBefore(static_cast<mesh::CellIndex>(i));
    });
    order.frontToBack.resize(count + 1);  // `release` writes one beyond what it finds
    mesh::CellIndex* const sorted = order.frontToBack.data();
    std::size_t done = 0, found = 0;
    for (mesh::CellIndex cell = 0; cell < count; ++cell)
        if (nearer[cell] == 0) sorted[found++] = cell;
    auto drain = [&] {
        while (done < found) {
            if (done + ahead < found) relations.prefetch(sorted[done + ahead]);
            found = relations.release(sorted[done++], nearer.data(), sorted, found);
        }
    };
    drain();
    constexpr std::uint32_t takenOut = 1u << 31;  // no cell is counted off as often
    order.cyclicCells = 0;
    std::vector<std::pair<double, mesh::CellIndex>> remaining;
    for (mesh::CellIndex cell = 0; found < count && cell < count; ++cell)
        if (nearer[cell] > 0) remaining.emplace_back(distanceOf(mesh, frame, cell), cell);
    std::sort(remaining.begin(), remaining.end());
    for (const auto& [distance, cell] : remaining) {
        if (nearer[cell] == 0) continue;
        ++order.cyclicCells;
        nearer[cell] = takenOut;
        sorted[found++] = cell;
        drain();
    }
    order.frontToBack.resize(count);
}

void invert(const std::vector<mesh::CellIndex>& order, std::vector<std::uint32_t>& places) {
    places.resize(order.size());
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, order.size(), 8192), [&](const auto& range) {
        for (std::size_t i = range.begin(); i != range.end(); ++i) places[order[i]] = static_cast<std::uint32_t>(i);
    });
}

/// Adds the pixels in which both cells of a pair that stands the wrong way round can be seen: a ray is composed wrongly
/// only if two cells that follow one another along it do.
void addUncertainPairs(const std::vector<CellPair>& wrong, const CellProjector& projector, const CameraFrame& frame,
                       std::vector<std::uint32_t>& uncertainPixels) {
    for (const auto& [near, far] : wrong) {
        PixelRect a, b;
        if (projector.bounds(near, a) != SkipReason::None || projector.bounds(far, b) != SkipReason::None) continue;
        for (int y = std::max(a.y0, b.y0); y < std::min(a.y1, b.y1); ++y)
            for (int x = std::max(a.x0, b.x0); x < std::min(a.x1, b.x1); ++x)
                uncertainPixels.push_back(static_cast<std::uint32_t>(y) * static_cast<std::uint32_t>(frame.width) +
                                          static_cast<std::uint32_t>(x));
    }
    std::sort(uncertainPixels.begin(), uncertainPixels.end());
    uncertainPixels.erase(std::unique(uncertainPixels.begin(), uncertainPixels.end()), uncertainPixels.end());
}

bool sameView(const CameraFrame& a, const CameraFrame& b) {
    return a.eye == b.eye && a.forward == b.forward && a.right == b.right && a.up == b.up &&
           a.perPixelRight == b.perPixelRight && a.perPixelDown == b.perPixelDown && a.orthographic == b.orthographic &&
           a.width == b.width && a.height == b.height && a.sampleShift == b.sampleShift;
}

}  // namespace

void VisibilitySorter::State::seeGaps(const CellProjector& projector) {
    last.uncertainPixels.clear();
    if (connected->boundary.empty()) return;
    Reentry reentry = findReentry(mesh, connected->boundary, projector.frame(), projector.points());
    last.uncertainPixels = std::move(reentry.uncertainPixels);
    relations->setGaps(std::move(reentry.edges));
}

/// The order by keys, by the last frame's order repaired, or by the relations alone: the first that keeps every
/// relation. Which pixels a cycle leaves in doubt is told by the relations that the order breaks.
void VisibilitySorter::State::findOrder(const CellProjector& projector) {
    const CameraFrame& frame = projector.frame();
    relations->see(projector);
    seeGaps(projector);
    const bool hasLast = !last.frontToBack.empty() && last.cyclicCells == 0;
    last.cyclicCells = 0;
    if (hasLast && relations->mostlyHold(last.places)) {
        const std::vector<CellPair> wrong = relations->violations(last.places);
        last.incrementalSort = wrong.empty() ? "kept" : "repaired";
        if (wrong.empty()) return;
        if (order->keys.empty() && repairOrder(*relations, wrong, last.frontToBack, last.places)) return;
    }
    last.incrementalSort = "sorted";
    if (!order->keys.empty()) {
        last.frontToBack = sortedByKeys(order->keys, frame);
        invert(last.frontToBack, last.places);
        if (relations->violations(last.places).empty()) return;  // else keys rounded, or the eye is far away
    }
    sortByRelations(*relations, mesh, frame, nearer, last);
    invert(last.frontToBack, last.places);
    if (last.cyclicCells > 0)
        addUncertainPairs(relations->violations(last.places), projector, frame, last.uncertainPixels);
}

const VisibilityOrder& VisibilitySorter::sort(const CameraFrame& frame) {
    return sort(CellProjector(state_->mesh, sceneUnits(state_->mesh), frame));
}

const VisibilityOrder& VisibilitySorter::sort(const CellProjector& projector) {
    State& state = *state_;
    const CameraFrame& frame = projector.frame();
    if (!state.lastFrame || !sameView(*state.lastFrame, frame)) {
        if (state.order->method == "centroid") {
            state.last.frontToBack = sortedByKeys(state.order->keys, frame);
            invert(state.last.frontToBack, state.last.places);
        } else {
            state.findOrder(projector);
        }
        state.lastFrame = frame;
    } else {
        state.last.incrementalSort = "kept";
    }
    return state.last;
}

std::vector<std::uint32_t> VisibilitySorter::pixelsOutOfOrder(const CellProjector& projector) {
    State& state = *state_;
    sort(projector);
    state.connect();
    state.relations->see(projector);
    state.seeGaps(projector);
    std::vector<std::uint32_t> pixels = std::exchange(state.last.uncertainPixels, {});
    addUncertainPairs(state.relations->violations(state.last.places), projector, projector.frame(), pixels);
    return pixels;
}

}  // namespace tetralux::projection
