// SPDX-License-Identifier: Apache-2.0
#include <projection/gl/gl_engine.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <utility>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>

#include <projection/cells/cell_constants.h>
#include <projection/cells/edge_on_planes.h>
#include <projection/cells/ray_inverse_depth.h>
#include <projection/core/transfer_support.h>
#include <projection/gl/gl_cell_order.h>
#include <projection/gl/gl_cell_program.h>
#include <projection/gl/gl_cell_stream.h>
#include <projection/gl/gl_context.h>
#include <projection/gl/gl_draw_trial.h>
#include <projection/gl/gl_fragment_count.h>
#include <projection/gl/gl_frame_target.h>
#include <projection/gl/gl_limits.h>
#include <projection/gl/gl_path.h>
#include <projection/gl/gl_resident_cells.h>
#include <projection/gl/gl_resolve.h>
#include <projection/gl/gl_sampler_probe.h>
#include <projection/gl/gl_tiles.h>
#include <projection/gl/gl_walk.h>
#include <glm/geometric.hpp>

namespace tetralux::projection {
namespace {

class Stopwatch {
public:
    /// Milliseconds since construction or the last call.
    double lap() {
        const auto now = std::chrono::steady_clock::now();
        return std::chrono::duration<double, std::milli>(now - std::exchange(last_, now)).count();
    }

private:
    std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

/// Everything that lives in the context, so that it can go while the context is current.
struct GlState {
    std::unique_ptr<GlFunctions> gl;
    std::string renderer;
    bool linearSampler = false;
    std::optional<GlFrameTarget> target;
    std::optional<GlCellStream> stream;
    std::optional<GlFragmentCount> fragments;
    std::optional<GlTableTexture> table;
    std::optional<GlVertexLight> vertexLight;
    std::array<std::unique_ptr<GlCellProgram>, 8> programs;  // by GlFrameKind: made when first needed
    std::optional<GlLimits> limits;                          // made when first needed
    std::optional<GlResidentCells> resident;                 // where the frame's cells come from, else from `stream`
    std::optional<GlTiles> tiles;                            // what draws them, else the rasterizer
};

/// Pixels by which outlines grow: rasterizers move vertices by up to half a step of their grid, and corners are float.
double outlineMargin(const GlFunctions& gl, const CameraFrame& frame) {
    GLint bits = 8;
    gl.GetIntegerv(GL_SUBPIXEL_BITS, &bits);
    return 2.0 * std::exp2(-std::clamp(bits, 4, 8)) + 4e-7 * std::max(frame.width, frame.height);
}

/// The longest edge of any cell, scene units: no segment is longer.
double longestEdge(const mesh::ScalarMesh& mesh, const SceneUnits& units) {
    return tbb::parallel_reduce(
        tbb::blocked_range<std::size_t>(0, mesh.cells.size(), 4096), 0.0,
        [&](const auto& range, double longest) {
            for (std::size_t cell = range.begin(); cell != range.end(); ++cell) {
                for (std::size_t i = 0; i < 4; ++i) {
                    for (std::size_t j = i + 1; j < 4; ++j) {
                        const glm::dvec3 edge =
                            mesh.positions[mesh.cells[cell][j]] - mesh.positions[mesh.cells[cell][i]];
                        longest = std::max(longest, glm::length(edge / units.length));
                    }
                }
            }
            return longest;
        },
        [](double a, double b) { return std::max(a, b); });
}

double wantedErrorOf(const Scene& scene) {
    return scene.settings.table.wantedError;
}

/// Silhouettes multiply depth by k, which makes faint segments opaque: their colours and extinction have to be right.
bool asksMeanColors(const Scene& scene) {
    return scene.settings.mode == Mode::FirstHit || scene.settings.shading.silhouette;
}

/// The colour of one segment, however faint, is the whole picture: what a table would have to hold for that costs more
/// than the nodes of one segment.
bool showsSingleSegments(const Scene& scene) {
    return scene.settings.mode == Mode::FirstHit && scene.settings.table.size == 0;
}

/// Samples ask for colour and extinction at one scalar: there is nothing to integrate.
bool takesSamples(const Scene& scene) {
    return scene.settings.classification != Classification::Preintegrated;
}

preint::PreintegrationTable buildTable(const Scene& scene, const preint::TransferFunction& function,
                                       const SceneUnits& units) {
    const preint::ExactIntegral exact(function);
    preint::TableOptions options = scene.settings.table;
    // the weights of contributions do not know the table's
    options.meanColors = asksMeanColors(scene) || scene.settings.contributions.any();
    options.evenTexelsFirst = !options.meanColors;
    options.wantedError = wantedErrorOf(scene);
    if (takesSamples(scene) || showsSingleSegments(scene))
        options.size = options.lengthSlices = 2;  // its zones are all
    const double largestScale = scene.settings.largestExtinctionScale;
    if (integralOf(scene.settings.mode) == preint::Integral::ScaleInvariant) {
        const bool adds = addsUp(scene.settings.mode);
        if (largestScale == 0.0 && !adds) return preint::buildScaleInvariantTable(exact, 0.0, 1.0, options);
        // scaled extinction is that of a longer path: the table of paths holds both, and what hides nothing
        return preint::buildStandardTable(exact, 0.0, 1.0, adds ? std::max(largestScale, 1.0) : largestScale, options);
    }
    return preint::buildStandardTable(exact, 0.0, 1.0, longestEdge(*scene.mesh, units) * std::max(largestScale, 1.0),
                                      options);
}

class GlEngine final : public Engine {
public:
    GlEngine(const Scene& scene, const EngineOptions& options)
        : scene_(scene),
          vertexLight_(vertexLightOf(scene)),
          units_(sceneUnits(*scene.mesh)),
          edgeOnPlanes_(*scene.mesh),
          function_(inSceneUnits(scene.transferFunction, units_, integralOf(scene.settings.mode))),
          scalarColors_(function_,
                        scene.mesh->association == mesh::Association::Cell && scene.settings.mode != Mode::Average),
          context_(makeGlContext(options.context)) {
        Stopwatch watch;
        layout_.gradient = modeLooksUp(mode()) && mode() != Mode::Depth && scene.settings.shading.needsGradient();
        if (modeLooksUp(mode())) {
            table_ = buildTable(scene, function_, units_);
            const bool misses = table_->measuredError > wantedTableError() && scene.settings.table.size == 0;
            const bool blurs = asksMeanColors(scene) && nodesCloserThanTexels(function_, *table_);
            if (misses || blurs || !looksUp()) walked_ = walkedPieces(function_, *table_);
            prepare_["table"] = watch.lap();
            const auto& shading = scene.settings.shading;
            fullLight_ = shading.lit() && !shading.plain();
            layout_.attributes =
                (fullLight_ && vertexLight_->any()) || vertexLight_->sampleAt >= 0 || shading.smoothSilhouettes();
            prepare_["light"] = watch.lap();
        }
        order_.emplace(scene, modeLooksUp(mode()) && !orderFree(mode()) && orderMatters(), modeLooksUp(mode()));
        prepare_["adjacency"] = watch.lap();
        const CurrentGlContext current(*context_);
        makeState();
        prepare_["context"] = watch.lap();
        choosePath(parseGlPath(options.glPath));
        prepare_["resident"] = watch.lap();
    }

    ~GlEngine() override {
        try {
            const CurrentGlContext current(*context_);
            state_.reset();
        } catch (const std::exception&) {
            // The context is lost and with it all that is in it; a destructor has no one to tell.
        }
    }

    Image render(const View& view, FrameReport& report) override;

    std::string name() const override { return "gl"; }
    std::string renderer() const override { return state_->renderer; }
    std::map<std::string, double> prepareMilliseconds() const override { return prepare_; }
    const preint::PreintegrationTable* table() const override { return table_ && looksUp() ? &*table_ : nullptr; }
    double wantedTableError() const override { return wantedErrorOf(scene_); }
    bool walksNodes() const override { return walked_.has_value(); }

private:
    Mode mode() const { return scene_.settings.mode; }
    bool looksUp() const { return !takesSamples(scene_) && !showsSingleSegments(scene_); }
    /// Blending cells of one colour is the same in any order; an order that was asked for is made all the same.
    bool orderMatters() const {
        const bool blends =
            (mode() == Mode::Standard || mode() == Mode::ScaleInvariant) && !scene_.settings.shading.needsGradient();
        return !blends || scene_.settings.order != OrderMethod::Auto || !onlyColor(scene_.transferFunction);
    }
    void makeState();
    void choosePath(GlPath wanted);
    const GlCellProgram& program(GlFrameKind kind);
    void setBlending() const;
    GlDrawing wayOfFrame(const CameraFrame& frame);
    const GlCellProgram& beginFrame(const View& view, const CameraFrame& frame, GlDrawing way);
    void drawStreamed(const CameraFrame& frame, const GlCellProgram& program, FrameReport& report);
    void drawRaster(const CameraFrame& frame, const GlCellProgram& program, const std::vector<mesh::CellIndex>* order,
                    FrameReport& report);
    void drawTiles(const CameraFrame& frame, const GlCellProgram& program, const std::vector<mesh::CellIndex>* order,
                   FrameReport& report);
    bool drawResident(const View& view, const CameraFrame& frame, FrameReport& report);
    bool drawInOrder(const View& view, const CameraFrame& frame, GlDrawing way, FrameReport& report);
    void checkScales(const PixelMaps& maps) const;
    CellCorners cellCorners(const CellProjector& projector, const CellRecord& record, const CameraFrame& frame,
                            mesh::CellIndex cell) const;
    void writeCells(const CellProjector& projector, const CameraFrame& frame, double margin,
                    const mesh::CellIndex* cells, std::size_t count, float* target) const;

    Scene scene_;
    std::shared_ptr<const shading::VertexLight> vertexLight_;
    bool fullLight_ = false;
    SceneUnits units_;
    EdgeOnPlanes edgeOnPlanes_;
    preint::TransferFunction function_;  // scene units
    ScalarColors scalarColors_;
    std::optional<preint::PreintegrationTable> table_;
    std::optional<WalkedPieces> walked_;  // in the table's stead, where that misses its error
    std::optional<GlCellOrder> order_;
    std::vector<CameraPoint> points_;
    GlCellLayout layout_;
    std::unique_ptr<GlContext> context_;
    std::optional<GlState> state_;
    GlPathChoice path_{GlPath::Stream, ""};
    GlDrawTrial trial_;
    std::map<std::string, double> prepare_;
};

void GlEngine::makeState() {
    state_.emplace();
    state_->gl = loadGlFunctions(*context_);
    const GlFunctions& gl = *state_->gl;
    state_->renderer = reinterpret_cast<const char*>(gl.GetString(GL_RENDERER));
    state_->target.emplace(gl);
    state_->fragments.emplace(gl);
    state_->stream.emplace(gl, layout_);
    if (table_) {
        if (walked_)
            state_->table.emplace(gl, *walked_);
        else
            state_->table.emplace(gl, *table_);
        state_->linearSampler = linearSamplerIsExact(gl);
        if (layout_.attributes) state_->vertexLight.emplace(gl, *vertexLight_);
    }
}

/// gl_path.h: the rule.
void GlEngine::choosePath(GlPath wanted) {
    const std::size_t chunk =
        isSoftwareRenderer(state_->renderer) ? GlResidentCells::softwareChunk : GlResidentCells::gpuChunk;
    const auto keepCells = [&] {
        state_->resident.emplace(*state_->gl, *scene_.mesh, units_, order_->visible(), order_->keys(),
                                 order_->relations(), vertexLight_->corners, layout_, chunk);
    };
    const auto makeTiles = [&] {
        const std::size_t cells = state_->resident->chunkCells();
        state_->tiles.emplace(*state_->gl, layout_, cells, 4 * cells + 1024);
        program({.tiles = true});
    };
    path_ = chooseGlPath(wanted, state_->renderer, keepCells, makeTiles);
    if (path_.path == GlPath::Stream) state_->resident.reset();
    if (path_.path != GlPath::Tiles && path_.path != GlPath::Measured) state_->tiles.reset();
}

GlDrawing GlEngine::wayOfFrame(const CameraFrame& frame) {
    if (!state_->tiles) return GlDrawing::Raster;
    if (path_.path == GlPath::Tiles) return GlDrawing::Tiles;
    return trial_.next(static_cast<std::uint64_t>(frame.width) * static_cast<std::uint64_t>(frame.height));
}

const GlCellProgram& GlEngine::program(GlFrameKind kind) {
    auto& made = state_->programs[(kind.orthographic ? 1u : 0u) + (kind.clipped ? 2u : 0u) + (kind.tiles ? 4u : 0u)];
    if (!made) {
        made = std::make_unique<GlCellProgram>(*state_->gl, scene_.settings, *vertexLight_, function_,
                                               table_ ? &*table_ : nullptr, walked_ ? &*walked_ : nullptr, kind,
                                               state_->linearSampler);
    }
    return *made;
}

/// Tables are made for the largest path that they are asked for.
void GlEngine::checkScales(const PixelMaps& maps) const {
    const auto largest = std::max_element(maps.extinctionScale.begin(), maps.extinctionScale.end());
    if (largest != maps.extinctionScale.end() &&
        static_cast<double>(*largest) > scene_.settings.largestExtinctionScale * (1.0 + 1e-6))
        throw std::runtime_error(
            "pixel map 'extinctionScale': a factor above the scene's largestExtinctionScale; set that to the largest");
}

void GlEngine::setBlending() const {
    const GlFunctions& gl = *state_->gl;
    gl.Disable(GL_DEPTH_TEST);
    gl.Disable(GL_CULL_FACE);
    if (mode() == Mode::FirstHit || mode() == Mode::Depth) {
        gl.Disable(GL_BLEND);  // what is in front overwrites
        return;
    }
    gl.Enable(GL_BLEND);
    gl.BlendEquation(mode() == Mode::Mip ? GL_MAX : mode() == Mode::Minimum ? GL_MIN : GL_FUNC_ADD);
    gl.BlendFunc(GL_ONE, orderFree(mode()) ? GL_ONE : GL_ONE_MINUS_SRC_ALPHA);
}

CellCorners GlEngine::cellCorners(const CellProjector& projector, const CellRecord& record, const CameraFrame& frame,
                                  mesh::CellIndex cell) const {
    const std::array<double, 4> eye = projector.eyeCoordinates(cell);
    const double perInverseDepth =
        frame.orthographic ? std::abs(frame.depthOrigin + static_cast<double>(record.scale)) * units_.length : 1.0;
    CellCorners corners;
    for (std::size_t k = 0; k < 4; ++k) {
        corners.eyeWeight[k] = static_cast<float>(eye[k] * perInverseDepth);
        corners.point[k] = vertexLight_->cornersOf(cell, scene_.mesh->cells[cell])[k];
    }
    return corners;
}

void GlEngine::writeCells(const CellProjector& projector, const CameraFrame& frame, double margin,
                          const mesh::CellIndex* cells, std::size_t count, float* target) const {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, 256), [&](const auto& range) {
        for (std::size_t i = range.begin(); i != range.end(); ++i) {
            const mesh::CellIndex cell = cells[i];
            const CellOutline outline = cellOutline(projector.cameraCorners(cell), frame, margin);
            const CellRecord record = projector.record(cell);
            writeCell(layout_, outline, record, layout_.gradient ? projector.gradient(cell) : CellGradient{},
                      layout_.attributes ? cellCorners(projector, record, frame, cell) : CellCorners{},
                      target + i * layout_.floats());
        }
    });
}

/// Clears the target and binds all that fragments read.
const GlCellProgram& GlEngine::beginFrame(const View& view, const CameraFrame& frame, GlDrawing way) {
    state_->target->begin(frame.width, frame.height, clearValue(mode()));
    const bool clipped = view.maps != nullptr && view.maps->changeVolume();
    const double depthReference = depthReferenceOf(scene_.mesh->bounds, frame, units_);
    if (clipped) {
        if (!state_->limits) state_->limits.emplace(*state_->gl);
        state_->limits->upload(*view.maps, frame, units_, depthReference);
        state_->limits->bind(limitsUnit);
    }
    if (state_->table) state_->table->bind(tableUnit);  // after uploads, which bind textures of their own
    if (state_->vertexLight) state_->vertexLight->bind(vertexLightUnit);
    const GlCellProgram& cellProgram = program({frame.orthographic, clipped, way == GlDrawing::Tiles});
    cellProgram.use(frame, depthReference);
    if (way == GlDrawing::Tiles)
        cellProgram.setTiles(frame, layout_.floats(), scene_.settings.earlyTermination ? leastTransmittance : -1.0f);
    if (fullLight_) cellProgram.setLights(frameLights(scene_.settings.shading, units_, frame, depthReference), units_);
    if (scene_.settings.shading.depthColor)
        cellProgram.setDepthRange(depthRange(scene_.mesh->bounds, view.camera), depthReference, units_);
    setBlending();
    return cellProgram;
}

void GlEngine::drawStreamed(const CameraFrame& frame, const GlCellProgram& cellProgram, FrameReport& report) {
    Stopwatch watch;
    auto& stages = report.stageMilliseconds;
    projectPoints(*scene_.mesh, units_, frame, points_);
    const CellProjector projector(*scene_.mesh, units_, frame, points_);
    stages["project"] += watch.lap();
    const std::vector<mesh::CellIndex>& cells = order_->drawnCells(projector, report);
    stages["setup"] = watch.lap() - order_->sortMilliseconds();
    if (report.orderMethod != "none") stages["sort"] = order_->sortMilliseconds();

    cellProgram.resume();
    const double margin = outlineMargin(*state_->gl, frame);
    state_->fragments->begin();
    const GlCellStream::Times times =
        state_->stream->draw(cells.size(), [&](std::size_t begin, std::size_t end, float* target) {
            writeCells(projector, frame, margin, cells.data() + begin, end - begin, target);
        });
    watch.lap();
    stages["setup"] += times.setup;
    stages["upload"] += times.upload;
    state_->fragments->end();
    report.fragments = state_->fragments->count();
    stages["draw"] += times.draw + watch.lap();
    report.dataPath = "stream";
    report.bytesUploaded += cells.size() * layout_.floats() * sizeof(float);
}

void GlEngine::drawRaster(const CameraFrame& frame, const GlCellProgram& cellProgram,
                          const std::vector<mesh::CellIndex>* order, FrameReport& report) {
    state_->fragments->begin();
    state_->resident->draw(frame, order, outlineMargin(*state_->gl, frame), [&] { cellProgram.resume(); });
    state_->fragments->end();
    report.fragments = state_->fragments->count();
    report.dataPath = "resident";
}

void GlEngine::drawTiles(const CameraFrame& frame, const GlCellProgram& cellProgram,
                         const std::vector<mesh::CellIndex>* order, FrameReport& report) {
    const auto draw = [&] {
        state_->resident->drawTiles(frame, order, outlineMargin(*state_->gl, frame), *state_->tiles,
                                    state_->target->texture(), [&] { cellProgram.resume(); });
    };
    draw();
    while (state_->tiles->overflowed()) {
        state_->target->begin(frame.width, frame.height, clearValue(mode()));
        draw();
    }
    const GlTileCounts counts = state_->tiles->counts();
    report.fragments = counts.fragments;
    report.tileEntries = counts.entries;
    report.tileEntriesSaved = counts.entriesSaved;
    report.tilesRetired = counts.retired;
    report.dataPath = "tiles";
}

/// False where the GPU could not put all cells in order: then nothing of the frame is of use.
bool GlEngine::drawInOrder(const View& view, const CameraFrame& frame, GlDrawing way, FrameReport& report) {
    Stopwatch watch;
    auto& stages = report.stageMilliseconds;
    const GlCellProgram& cellProgram = beginFrame(view, frame, way);
    stages["draw"] = watch.lap();
    order_->describe(report);
    const std::vector<mesh::CellIndex>* order = nullptr;
    if (order_->ofWholeMesh()) {
        projectPoints(*scene_.mesh, units_, frame, points_);
        const CellProjector projector(*scene_.mesh, units_, frame, points_);
        stages["project"] = watch.lap();
        order = &order_->backToFront(projector, report);
        stages["sort"] = watch.lap();
    }
    watch.lap();
    if (way == GlDrawing::Tiles) {
        drawTiles(frame, cellProgram, order, report);
    } else {
        drawRaster(frame, cellProgram, order, report);
    }
    const GlFrameCounts counts = state_->resident->counts();
    stages["draw"] += watch.lap();  // culling, sorting and set-up too: the GPU does not say when it ends them
    report.bytesUploaded = state_->resident->uploadedLast();
    report.cellsDrawn = counts.drawn;
    if (order_->keys() != nullptr) report.cellsSorted = counts.drawn;
    const std::uint64_t leftOut = order != nullptr ? order_->visible().size() - order->size() : 0;
    order_->tellSkipped(counts.outsideView + leftOut, counts.noPixelCentre, report);
    return counts.unsettled == 0;
}

/// The frame by cells on the GPU, as the path has it; the same.
bool GlEngine::drawResident(const View& view, const CameraFrame& frame, FrameReport& report) {
    const GlDrawing way = wayOfFrame(frame);
    Stopwatch watch;
    bool drawn = false;
    try {
        drawn = drawInOrder(view, frame, way, report);
    } catch (const std::runtime_error& error) {
        if (way == GlDrawing::Raster) throw;
        report.stageMilliseconds.clear();
        drawn = drawInOrder(view, frame, GlDrawing::Raster, report);  // throws too where tiles are not to blame
        state_->tiles.reset();  // a variant that the driver refuses, or more pairs than a buffer holds
        path_ = {GlPath::Resident, error.what()};
    }
    if (path_.path == GlPath::Measured) trial_.took(watch.lap(), report.cellsDrawn);
    report.dataPathReason = path_.path == GlPath::Measured ? trial_.reason() : path_.reason;
    if (!drawn) report.dataPathReason = "the GPU could not put all cells in order";
    return drawn;
}

Image GlEngine::render(const View& view, FrameReport& report) {
    checkPixelMaps(view);
    if (view.maps != nullptr) checkScales(*view.maps);
    checkStop(view.control);
    Stopwatch whole, watch;
    auto& stages = report.stageMilliseconds;
    CameraFrame frame = sampledFrame(view.camera, edgeOnPlanes_);
    frame.depthOrigin = depthOriginOf(scene_.mesh->bounds, frame, units_);
    report.floatSamples = frame.sampleShift;
    const CurrentGlContext current(*context_);
    report.dataPathReason = path_.reason;
    bool drawn = false;
    if (state_->resident) {
        drawn = drawResident(view, frame, report);
        watch.lap();
    }
    if (!drawn) {
        const GlCellProgram& cellProgram = beginFrame(view, frame, GlDrawing::Raster);
        stages["draw"] += watch.lap();
        drawStreamed(frame, cellProgram, report);
    }
    watch.lap();
    checkStop(view.control);
    Image image = state_->target->read();
    const GlGathered gathered{mode(), depthRange(scene_.mesh->bounds, view.camera),
                              depthReferenceOf(scene_.mesh->bounds, frame, units_), units_.length,
                              scene_.settings.contributions.sums};
    const std::vector<std::uint32_t> uncertain = resolveOrderFree(image, gathered, scalarColors_);
    report.uncertainPixels.insert(report.uncertainPixels.end(), uncertain.begin(), uncertain.end());
    stages["read back"] = watch.lap();
    report.frameMilliseconds = whole.lap();
    if (scene_.settings.order == OrderMethod::Centroid)  // to be measured, and not part of what it takes
        order_->tellDisorder(CellProjector(*scene_.mesh, units_, frame), report);
    return image;
}

}  // namespace

std::unique_ptr<Engine> makeGlEngine(const Scene& scene, const EngineOptions& options) {
    return std::make_unique<GlEngine>(scene, options);
}

}  // namespace tetralux::projection
