// SPDX-License-Identifier: Apache-2.0
#include <projection/cpu/cpu_engine.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <memory>
#include <numeric>
#include <optional>
#include <thread>
#include <utility>

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>
#include <tbb/task_arena.h>
#include <glm/geometric.hpp>

#include <projection/cells/ray_inverse_depth.h>
#include <projection/core/transfer_support.h>
#include <projection/cpu/cpu_bins.h>
#include <projection/cpu/cpu_cull.h>
#include <projection/cpu/cpu_limits.h>
#include <projection/cpu/cpu_order.h>
#include <projection/cpu/cpu_quick_variant.h>
#include <projection/cpu/cpu_tile.h>
#include <projection/light/vertex_samples.h>

namespace tetralux::projection {

namespace {

using Clock = std::chrono::steady_clock;

double millisecondsSince(Clock::time_point start) {
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

/// Rounding of inverse depth that the order check allows for, relative to the mesh's extent.
constexpr double orderRounding = 1e-6;

/// Nodes that a line meets within this are walked along as one piece (CpuTransfer).
constexpr double nodeTolerance = 1e-5;

/// Bytes that malloc hands on without asking the system (glibc's DEFAULT_MMAP_THRESHOLD_MAX).
constexpr std::size_t mostRecycled = std::size_t{32} << 20;

/// Above this share of cells that show, those that do not are passed over by bits instead of left out of a list.
constexpr double leastShareForBits = 0.8;

/// Counts per chunk and tile are kept below this, and chunks above a size that is worth a task.
constexpr std::size_t mostPlaces = std::size_t{1} << 20, leastChunk = 4096, usualChunk = 16384;

/// What one frame leaves to the next, of this engine or of another one of the same renderer.
struct CpuFrameMemory {
    std::optional<CpuOrder> order;  // of the last frame
    std::vector<CameraPoint> points;
    std::unique_ptr<VisibleCell[]> visibleCells;  // room for all candidates; memory is taken where some survive
    std::size_t visibleCellRoom = 0;
    std::vector<VisibleCellChunk> chunks;
    TileBins bins;
    std::vector<std::uint32_t> tilesByWork;
};

class CpuEngine final : public Engine {
public:
    CpuEngine(const Scene& scene, const CpuSkips& skips)
        : scene_(scene),
          skips_(skips),
          mesh_(*scene.mesh),
          units_(sceneUnits(mesh_)),
          transfer_(inSceneUnits(scene.transferFunction, units_, integralOf(scene.settings.mode)),
                    scene.settings.everyNode ? 0.0 : nodeTolerance),
          scalarColors_(inSceneUnits(scene.transferFunction, units_, integralOf(scene.settings.mode)),
                        mesh_.association == mesh::Association::Cell && scene.settings.mode != Mode::Average),
          memory_(scene.frameMemory ? scene.frameMemory->take<CpuFrameMemory>() : std::make_shared<CpuFrameMemory>()) {
        prepare();
    }

    ~CpuEngine() override {
        memory_->order = std::move(orderKeys_);
        if (scene_.frameMemory) scene_.frameMemory->leave(std::move(memory_));
    }

    Image render(const View& view, FrameReport& report) override {
        checkPixelMaps(view);
        const Camera& camera = view.camera;
        const auto start = Clock::now();
        if (!(skips_.keepFrame && keptCamera_ == camera)) {
            keptCamera_.reset();
            makeLists(view, report);
            keptCamera_ = camera;
        }
        setLimits(view);
        Image image(camera.width, camera.height);  // only now: it takes the place of the visible cells
        draw(view.control, image, report);
        report.cellsSkipped = skipped_;
        report.cellsDrawn = cellsDrawn_;
        report.orderMethod = order_.method;
        report.orderCycles = order_.cyclicCells;
        report.incrementalSort = order_.method == "none" ? "none" : order_.incrementalSort;
        report.failingFaces = order_.failingFaces;
        report.frameMilliseconds = millisecondsSince(start);
        return image;
    }

    std::string name() const override { return "cpu"; }
    std::string renderer() const override {
        return fmt::format("{}, {} threads", tileInstructionSet(), tbb::this_task_arena::max_concurrency());
    }
    std::map<std::string, double> prepareMilliseconds() const override { return prepareMilliseconds_; }

private:
    void prepare();
    void findShownCells();
    TileKind kind() const;
    /// Whether shading asks for silhouettes at most, which the quick kernel of optical depths knows.
    bool quickDepth() const {
        return skips_.quickVariants && !samplesVertices(scene_) && silhouettesAtMost(scene_.settings.shading);
    }
    bool ordered() const { return !orderFree(scene_.settings.mode) && frame_.kind != TileKind::Absorption; }
    void makeLists(const View& view, FrameReport& report);
    void setFrame();
    CullCounts cull(const FrameControl* control);
    void setLimits(const View& view);
    void draw(const FrameControl* control, Image& image, FrameReport& report);
    void sortTilesByWork();

    const Scene scene_;
    const CpuSkips skips_;
    const mesh::ScalarMesh& mesh_;
    const SceneUnits units_;
    const CpuTransfer transfer_;
    const ScalarColors scalarColors_;
    std::shared_ptr<CpuFrameMemory> memory_;
    std::map<std::string, double> prepareMilliseconds_;

    // of the scene
    std::vector<float> scalars_;
    std::vector<mesh::CellIndex> shownCells_;  // the cells that show, where far from all do; else empty, and
    std::vector<std::uint64_t> shown_;  // one bit per cell, empty where all show: an eighth of a byte instead of four
    std::uint64_t invisible_ = 0;
    std::optional<CpuOrder> orderKeys_;
    std::shared_ptr<const shading::VertexLight> vertexLight_;

    // of the last camera
    std::optional<Camera> keptCamera_;
    CameraFrame cameraFrame_;
    TileFrame frame_{};
    TileLimits limits_;
    bool clipped_ = false;  // this frame takes drawClippedTile
    int tilesX_ = 0, tilesY_ = 0;
    CpuFrameOrder order_;
    std::uint64_t cellsDrawn_ = 0;
    std::map<std::string, std::uint64_t> skipped_;
};

TileKind CpuEngine::kind() const {
    const auto& shading = scene_.settings.shading;
    switch (scene_.settings.mode) {
        case Mode::Mip:
            return TileKind::Mip;
        case Mode::Minimum:
            return TileKind::Minimum;
        case Mode::Average:
            return TileKind::Average;
        case Mode::FirstHit:
            return TileKind::FirstHit;
        case Mode::Additive:
        case Mode::DataAdditive:
        case Mode::Emission:
            return TileKind::Additive;
        case Mode::Absorption:
            return TileKind::Absorption;
        case Mode::Depth:
            return TileKind::Depth;
        default:
            break;
    }
    // other classifications show no isosurfaces, so that theirs do not count for one colour
    const bool plain = scene_.settings.classification == Classification::Preintegrated;
    const bool oneColor =
        skips_.orderFree && plain && transfer_.constantColor() && !scene_.settings.contributions.perCell;
    // so do samples at the vertices: kernels without it do not know where in a cell a segment lies
    if (shading.needsGradient() || samplesVertices(scene_))
        return oneColor && quickDepth() ? TileKind::Absorption : TileKind::Shaded;
    return oneColor ? TileKind::Absorption : TileKind::Composite;
}

void CpuEngine::prepare() {
    const auto start = Clock::now();
    scalars_.resize(mesh_.scalars.size());
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, scalars_.size(), 4096), [&](const auto& range) {
        for (std::size_t i = range.begin(); i != range.end(); ++i)
            scalars_[i] = static_cast<float>(units_.toUnit(mesh_.scalars[i]));
    });
    frame_.kind = kind();
    frame_.cells = mesh_.cells.data();
    frame_.scalars = scalars_.data();
    frame_.fieldScalars = mesh_.scalars.data();
    frame_.scalarScale = units_.scalarScale;
    frame_.cellData = mesh_.association == mesh::Association::Cell;
    frame_.transfer = &transfer_;
    frame_.scalarColors = &scalarColors_;
    frame_.scaleInvariant = integralOf(scene_.settings.mode) == preint::Integral::ScaleInvariant;
    const auto& shading = scene_.settings.shading;
    vertexLight_ = vertexLightOf(scene_);
    frame_.shading = &shading;
    frame_.lightInFull = shading.lit() && !shading.plain();
    frame_.smoothSilhouettes = shading.smoothSilhouettes();
    frame_.attributes =
        (frame_.lightInFull && vertexLight_->any()) || vertexLight_->sampleAt >= 0 || frame_.smoothSilhouettes;
    frame_.lightModel = lightModelFloats(shading);
    frame_.vertexLight = vertexLight_.get();
    frame_.earlyTermination = skips_.earlyTermination && scene_.settings.earlyTermination;
    frame_.ordered = ordered();
    frame_.classification = scene_.settings.classification;
    frame_.constantColor = scene_.settings.mode == Mode::Absorption ? glm::vec3(0) : glm::vec3(transfer_.color());
    frame_.contributions = scene_.settings.contributions;
    frame_.emissionOnly = scene_.settings.mode == Mode::Emission;
    const bool everyScalarCounts =
        frame_.kind == TileKind::Mip || frame_.kind == TileKind::Minimum || frame_.kind == TileKind::Average;
    if (skips_.invisibleCells && scene_.settings.skipInvisible && !everyScalarCounts) findShownCells();
    prepareMilliseconds_["cells"] = millisecondsSince(start);
    if (!frame_.ordered || !skips_.sort) return;
    const auto orderStart = Clock::now();
    orderKeys_.emplace(mesh_, scene_.settings.order, scene_.meshMemo.get());
    if (memory_->order) orderKeys_->takeOver(std::move(*memory_->order));
    memory_->order.reset();
    prepareMilliseconds_["order"] = millisecondsSince(orderStart);
}

/// Which cells the transfer function shows: asked once, since it depends on no camera.
void CpuEngine::findShownCells() {
    const auto& function = scene_.transferFunction;
    const auto support = extinctionSupport(function);
    const auto integral = integralOf(scene_.settings.mode);
    std::vector<std::uint8_t> shows(mesh_.cells.size());
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, shows.size(), 4096), [&](const auto& range) {
        for (std::size_t i = range.begin(); i != range.end(); ++i) {
            const glm::dvec2 scalars = scalarRange(mesh_, static_cast<mesh::CellIndex>(i));
            shows[i] = rangeShows(function, support, scalars.x, scalars.y, integral);
        }
    });
    const auto count = static_cast<std::size_t>(std::count(shows.begin(), shows.end(), std::uint8_t{1}));
    invisible_ = shows.size() - count;
    if (invisible_ == 0) return;
    if (static_cast<double>(count) > leastShareForBits * static_cast<double>(shows.size())) {
        shown_.resize((shows.size() + 63) / 64);
        for (std::size_t i = 0; i < shows.size(); ++i) shown_[i / 64] |= std::uint64_t{shows[i]} << i % 64;
        return;
    }
    shownCells_.reserve(count);
    for (std::size_t i = 0; i < shows.size(); ++i)
        if (shows[i]) shownCells_.push_back(static_cast<mesh::CellIndex>(i));
}

void CpuEngine::setFrame() {
    const CameraFrame& frame = cameraFrame_;
    frame_.camera = &frame;
    frame_.points = memory_->points.data();
    frame_.orthographic = frame.orthographic;
    frame_.width = frame.width;
    frame_.height = frame.height;
    frame_.centre = sampleCentre(frame);
    frame_.rowLean = frame.rowLean;
    frame_.rowStretch = frame.rowStretch;
    frame_.pixel = frame.pixel / (frame.orthographic ? units_.length : 1.0);
    frame_.depthReference = depthReferenceOf(mesh_.bounds, frame, units_);
    frame_.orderTolerance = static_cast<float>(orderRounding / (frame.orthographic ? 1.0 : frame_.depthReference));
    const auto& shading = scene_.settings.shading;
    frame_.axes = {glm::vec3(frame.right), glm::vec3(-frame.up), glm::vec3(frame.forward)};
    frame_.fullLights = frameLights(shading, units_, frame, frame_.depthReference);
    frame_.lights.clear();
    for (const auto& light : shading.lights) {
        const glm::dvec3 towards = glm::normalize(light.towards);
        frame_.lights.push_back({static_cast<float>(glm::dot(towards, frame.right)),
                                 static_cast<float>(-glm::dot(towards, frame.up)),
                                 static_cast<float>(glm::dot(towards, frame.forward))});
    }
    if (skips_.quickVariants) frame_.variant = quickVariant(shading, frame_);
}

/// The pixel maps as inverse depth along rays, and whether the frame needs the kernel that honours them.
void CpuEngine::setLimits(const View& view) {
    limits_ = {};
    const bool mapped = view.maps != nullptr && view.maps->changeVolume();
    if (mapped) limits_ = tileLimits(*view.maps, cameraFrame(view.camera), frame_, units_);
    frame_.limits = mapped ? &limits_ : nullptr;
    const auto& shading = scene_.settings.shading;
    const bool quickKind = frame_.kind == TileKind::Composite || frame_.kind == TileKind::Shaded ||
                           frame_.kind == TileKind::FirstHit ||
                           (frame_.kind == TileKind::Absorption && (!shading.needsGradient() || quickDepth()));
    clipped_ =
        mapped || !quickKind || frame_.classification != Classification::Preintegrated || frame_.contributions.perCell;
    const DepthRange range = depthRange(mesh_.bounds, view.camera);
    frame_.greyOfReference = range.greyAt(frame_.depthReference * units_.length);
    frame_.greyPerDistance = range.greyPerDistance() * units_.length;
}

void CpuEngine::makeLists(const View& view, FrameReport& report) {
    auto& stages = report.stageMilliseconds;
    auto start = Clock::now();
    auto finish = [&](const char* stage) {
        stages[stage] += millisecondsSince(start);
        start = Clock::now();
        checkStop(view.control);
    };
    cameraFrame_ = cameraFrame(view.camera);
    const CameraFrame& frame = cameraFrame_;
    projectPoints(mesh_, units_, frame, memory_->points);
    setFrame();
    finish("project");

    tilesX_ = (frame.width + cpuTileSize - 1) / cpuTileSize;
    tilesY_ = (frame.height + cpuTileSize - 1) / cpuTileSize;
    order_ = {};
    CullCounts counts;
    const auto sort = [&] { return orderKeys_->orderOf(CellProjector(mesh_, units_, frame, memory_->points)); };
    if (orderKeys_ && !orderKeys_->keyed()) {  // part of it is for one thread alone
        CpuFrameOrder sorted;
        tbb::parallel_invoke(
            [&] {
                sorted = sort();
                finish("sort");
            },
            [&] { counts = cull(view.control); });
        order_ = std::move(sorted);
    } else {
        if (orderKeys_) order_ = sort();
        counts = cull(view.control);
    }
    finish("cull");
    memory_->bins.fill(memory_->visibleCells.get(), memory_->chunks, counts.nearest, counts.farthest, order_.places,
                       view.control);
    if (memory_->visibleCellRoom * sizeof(VisibleCell) <= mostRecycled) {
        memory_->visibleCells.reset();
        memory_->visibleCellRoom = 0;
    }
    sortTilesByWork();
    finish("bin");
    if (orderKeys_) {
        memory_->bins.sort(view.control);
        report.cellsSorted = cellsDrawn_;
        finish("sort");
    }
}

CullCounts CpuEngine::cull(const FrameControl* control) {
    const bool listed = invisible_ > 0 && shown_.empty();
    const std::size_t candidates = listed ? shownCells_.size() : mesh_.cells.size();
    const std::size_t tiles = static_cast<std::size_t>(tilesX_) * static_cast<std::size_t>(tilesY_);
    const std::size_t wanted =
        std::max({leastChunk, std::min(usualChunk, candidates / 64), candidates * tiles / mostPlaces + 1});
    const std::size_t chunkSize = (wanted + 63) / 64 * 64;  // whole words of shown_
    const std::size_t chunkCount = (candidates + chunkSize - 1) / chunkSize;
    if (memory_->visibleCellRoom < candidates) {
        // no smaller than the picture, so that malloc gives the picture the same pages (makeLists lets go of them)
        const std::size_t pictureBytes = sizeof(glm::vec4) * tiles * cpuTileSize * cpuTileSize;
        memory_->visibleCellRoom = std::max(candidates, pictureBytes / sizeof(VisibleCell) + 1);
        memory_->visibleCells = std::make_unique_for_overwrite<VisibleCell[]>(memory_->visibleCellRoom);
    }
    memory_->chunks.resize(chunkCount);
    memory_->bins.reset(chunkCount, tilesX_, tilesY_);
    std::vector<CullCounts> counts(chunkCount);
    tbb::parallel_for(std::size_t{0}, chunkCount, [&](std::size_t c) {
        checkStop(control);
        const std::size_t begin = c * chunkSize, end = std::min(candidates, begin + chunkSize);
        const CullTask task{listed ? shownCells_.data() : nullptr,
                            shown_.empty() ? nullptr : shown_.data(),
                            begin,
                            end,
                            order_.keys,
                            memory_->visibleCells.get() + begin,
                            tilesX_,
                            memory_->bins.counts(c)};
        memory_->chunks[c] = {begin, cullCells(frame_, task, counts[c])};
    });
    cellsDrawn_ = 0;
    for (const auto& chunk : memory_->chunks) cellsDrawn_ += chunk.count;
    CullCounts sum;
    for (const auto& count : counts) {
        sum.outsideView += count.outsideView;
        sum.noPixelCentre += count.noPixelCentre;
        sum.nearest = std::max(sum.nearest, count.nearest);
        sum.farthest = std::min(sum.farthest, count.farthest);
    }
    skipped_.clear();
    auto skip = [&](SkipReason reason, std::uint64_t cells) {
        if (cells > 0) skipped_[skipReasonName(reason)] = cells;
    };
    skip(SkipReason::OutsideView, sum.outsideView);
    skip(SkipReason::NoPixelCentre, sum.noPixelCentre);
    skip(SkipReason::Invisible, invisible_);
    return sum;
}

/// Longest lists first, so that no thread is left alone with one at the end.
void CpuEngine::sortTilesByWork() {
    memory_->tilesByWork.resize(memory_->bins.tileCount());
    std::iota(memory_->tilesByWork.begin(), memory_->tilesByWork.end(), 0u);
    std::stable_sort(memory_->tilesByWork.begin(), memory_->tilesByWork.end(), [&](std::uint32_t a, std::uint32_t b) {
        return memory_->bins.tile(a).size() > memory_->bins.tile(b).size();
    });
}

void CpuEngine::draw(const FrameControl* control, Image& image, FrameReport& report) {
    const auto start = Clock::now();
    std::vector<TileResult> results(memory_->bins.tileCount());
    std::atomic<std::size_t> next{0};
    const int threads = tbb::this_task_arena::max_concurrency();
    const auto starter = std::this_thread::get_id();
    tbb::parallel_for(
        0, threads,
        [&](int) {
            for (std::size_t i = next++; i < memory_->tilesByWork.size(); i = next++) {
                checkStop(control);
                if (std::this_thread::get_id() == starter)
                    tellProgress(control, static_cast<double>(i) / static_cast<double>(memory_->tilesByWork.size()));
                const std::uint32_t tile = memory_->tilesByWork[i];
                const auto columns = static_cast<std::uint32_t>(tilesX_);
                (clipped_ ? drawClippedTile : drawTile)(frame_, static_cast<int>(tile % columns) * cpuTileSize,
                                                        static_cast<int>(tile / columns) * cpuTileSize,
                                                        memory_->bins.tile(tile), image, results[tile]);
            }
        },
        tbb::simple_partitioner());
    std::vector<std::uint32_t> uncertainPixels = order_.uncertainPixels;
    std::uint64_t cellsSetUp = 0;
    for (const TileResult& result : results) {
        report.fragments += result.fragments;
        cellsSetUp += result.cellsSetUp;
        report.tilesRetired += result.retired ? 1 : 0;
        uncertainPixels.insert(uncertainPixels.end(), result.uncertainPixels.begin(), result.uncertainPixels.end());
    }
    report.tileEntries = memory_->bins.entryCount();
    report.tileEntriesSaved = report.tileEntries - cellsSetUp;
    std::sort(uncertainPixels.begin(), uncertainPixels.end());
    uncertainPixels.erase(std::unique(uncertainPixels.begin(), uncertainPixels.end()), uncertainPixels.end());
    report.uncertainPixels = std::move(uncertainPixels);
    report.stageMilliseconds["draw"] += millisecondsSince(start);
}

}  // namespace

std::unique_ptr<Engine> makeCpuEngineWith(const Scene& scene, const CpuSkips& skips) {
    return std::make_unique<CpuEngine>(scene, skips);
}

std::unique_ptr<Engine> makeCpuEngine(const Scene& scene, const EngineOptions&) {
    return makeCpuEngineWith(scene, CpuSkips{});
}

}  // namespace tetralux::projection
