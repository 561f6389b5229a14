// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

#include <fmt/format.h>
#include <tbb/info.h>
#include <tbb/task_arena.h>

#include <projection/core/clip_region.h>
#include <projection/core/perturbed_isosurfaces.h>
#include <projection/frame/engine_registry.h>
#include <projection/frame/shown_points.h>
#include <projection/frame/suggested_extinction.h>
#include <projection/frame/verification.h>
#include <projection/light/lighting_file.h>
#include <projection/opaque/boundary_surface.h>
#include <projection/opaque/opaque_layer.h>
#include <projection/reference/reference_ray_caster.h>
#include <projection/reference/reference_segment.h>
#include <projection/renderer/errors.h>
#include <projection/renderer/mesh_data.h>
#include <projection/renderer/scene_settings.h>
#include <tetralux/tetralux.h>

namespace tetralux {

namespace {

using Clock = std::chrono::steady_clock;

constexpr std::uint32_t verificationSeed = 1;  // the same pixels each time

double millisecondsSince(Clock::time_point start) {
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

std::ptrdiff_t rowLength(const ImageView& image) {
    return image.floatsPerRow != 0 ? image.floatsPerRow : 4 * static_cast<std::ptrdiff_t>(image.width);
}

void checkView(const ImageView& image) {
    if (image.rgba == nullptr) throw Error(Errc::BadInput, "image: no memory; give room for width × height × 4 floats");
    if (image.width < 1 || image.height < 1 || std::abs(rowLength(image)) < 4 * std::ptrdiff_t{image.width})
        throw Error(Errc::BadInput, fmt::format("image: {}x{} pixels in rows of {} floats; give at least 4 a pixel",
                                                image.width, image.height, rowLength(image)));
}

void copyTo(const ImageView& view, const projection::Image& image) {
    for (int y = 0; y < view.height; ++y)
        std::memcpy(view.rgba + y * rowLength(view), &image.at(0, y),
                    sizeof(glm::vec4) * static_cast<std::size_t>(view.width));
}

projection::Image copyOf(const ImageView& view) {
    projection::Image image(view.width, view.height);
    for (int y = 0; y < view.height; ++y)
        std::memcpy(&image.at(0, y), view.rgba + y * rowLength(view),
                    sizeof(glm::vec4) * static_cast<std::size_t>(view.width));
    return image;
}

bool holdsSomething(const ClipBox& box) {
    return box.low[0] < box.high[0] && box.low[1] < box.high[1] && box.low[2] < box.high[2];
}

void checkDepthLimit(const float* limits, const projection::Camera& camera) {
    const auto width = static_cast<std::size_t>(camera.width), height = static_cast<std::size_t>(camera.height);
    for (std::size_t pixel = 0; pixel < width * height; ++pixel)
        if (std::isnan(limits[pixel]))
            throw Error(Errc::BadInput,
                        fmt::format("depth limit: pixel {},{} is NaN; give infinity where nothing stands",
                                    pixel % width, pixel / width));
}

/// What the caller limits in this frame alone, for `camera`, whose picture may be smaller than that which is `wanted`:
/// each of its pixels ends where the wanted one in its middle does.
std::optional<projection::PixelMaps> limitsOf(const Control& control, const projection::Camera& camera,
                                              const projection::Camera& wanted) {
    if (control.depthLimit == nullptr && !holdsSomething(control.region)) return std::nullopt;
    projection::PixelMaps maps;
    if (holdsSomething(control.region)) {
        const auto& [low, high] = control.region;
        projection::ClipRegion(projection::boxHalfSpaces({low[0], low[1], low[2]}, {high[0], high[1], high[2]}), 0.0)
            .apply(camera, maps);
        maps.cutLayerEnd.clear();  // a part of space is no cut: what lies at its border is lit as anywhere
        maps.cutNormal.clear();
    }
    if (control.depthLimit == nullptr) return maps;
    for (int y = 0; y < camera.height; ++y) {
        const auto row = static_cast<std::size_t>((2 * y + 1) * wanted.height / (2 * camera.height));
        for (int x = 0; x < camera.width; ++x) {
            const auto column = static_cast<std::size_t>((2 * x + 1) * wanted.width / (2 * camera.width));
            const float limit = control.depthLimit[row * static_cast<std::size_t>(wanted.width) + column];
            projection::cutFarther(camera, maps, static_cast<std::size_t>(y * camera.width + x),
                                   std::max(0.0, static_cast<double>(limit)));
        }
    }
    return maps;
}

/// What frames of a scene take: base + perPixel · pixels, by the last frames of different sizes.
class FrameCost {
public:
    void add(double pixels, double milliseconds) {
        if (pixels == pixels_[1]) {
            milliseconds_[1] = milliseconds;
            return;
        }
        pixels_[0] = std::exchange(pixels_[1], pixels);
        milliseconds_[0] = std::exchange(milliseconds_[1], milliseconds);
    }
    void forget() { *this = FrameCost(); }

    /// As many of `most` pixels as `milliseconds` allow; a 64th of them where nothing is known yet.
    double pixelsWithin(double milliseconds, double most) const {
        constexpr double first = 1.0 / 64, least = 1.0 / 1024;
        if (pixels_[1] == 0) return first * most;
        double perPixel = milliseconds_[1] / pixels_[1], base = 0;
        if (pixels_[0] > 0) {
            const double slope = (milliseconds_[1] - milliseconds_[0]) / (pixels_[1] - pixels_[0]);
            if (slope > 0 && slope < perPixel) {
                base = milliseconds_[1] - slope * pixels_[1];
                perPixel = slope;
            }
        }
        return std::clamp((milliseconds - base) / perPixel, least * most, most);
    }

private:
    double pixels_[2] = {}, milliseconds_[2] = {};
};

}  // namespace

struct Renderer::State {
    std::shared_ptr<const Mesh> mesh;
    RendererOptions options;
    std::unique_ptr<tbb::task_arena> arena;

    // what was set
    std::optional<Field> field;
    std::optional<TransferFunction> function;
    Mode mode = Mode::Standard;
    shading::ShadingSettings lighting;
    Silhouettes silhouettes = Silhouettes::None;
    std::vector<Cut> cuts;
    std::optional<double> cutLayer;
    std::vector<Slice> slices;
    std::vector<Surface> surfaces;
    int pixelSamples = 1;
    std::optional<Boundary> boundary;

    // what was made of it, tier by tier; `made` says down to which it is still true
    enum class Tier { Nothing, Field, Appearance };
    Tier made = Tier::Nothing;
    std::shared_ptr<const mesh::ScalarMesh> drawn;
    std::uint64_t withoutScalar = 0;
    std::optional<mesh::VolumeSamples> volumeSamples;  ///< of `drawn`, once a function asked for them
    std::shared_ptr<projection::FrameMemory> memory = std::make_shared<projection::FrameMemory>();
    projection::Scene scene;
    projection::SceneParts parts;  ///< what its map sources were made of
    std::unique_ptr<projection::Engine> engine;
    FrameCost cost;

    // of the last frame
    projection::Camera camera;
    std::shared_ptr<const projection::PixelMaps> maps;

    void changed(Tier stillTrue) { made = std::min(made, stillTrue); }

    void run(const std::function<void()>& work) {
        if (options.arena)
            options.arena(work);
        else
            arena->execute(work);
    }

    void make();
    void makeField();
    void makeAppearance();
    projection::Camera withinBudget(const projection::Camera& view, double budget) const;
    projection::Image draw(const projection::Camera& view, const Control& control,
                           const projection::FrameControl& waiting, projection::FrameReport& report);
    PixelProbe probe(const projection::Camera& view, int x, int y);
};

void Renderer::State::make() {
    if (!field) throw Error(Errc::BadInput, "renderer: no field; give one with setField before the first frame");
    if (made < Tier::Field) makeField();
    if (made < Tier::Appearance) makeAppearance();
}

void Renderer::State::makeField() {
    engine.reset();  // what it leaves behind the next one takes
    volumeSamples.reset();
    drawn = renderer::scalarMesh(mesh->data(), *field, withoutScalar);
    made = Tier::Field;
}

void Renderer::State::makeAppearance() {
    engine.reset();
    projection::Scene next;
    next.mesh = drawn;
    next.settings.mode = renderer::sceneMode(mode);
    next.settings.samples = pixelSamples;
    next.settings.shading = lighting;
    next.settings.shading.silhouette = silhouettes != Silhouettes::None;
    next.settings.shading.approximateSilhouette = silhouettes == Silhouettes::Approximate;
    next.settings.threads = projection::RenderSettings::threadsOfCaller;
    projection::FunctionUse use;
    use.mode = next.settings.mode;
    const preint::TransferFunction chosen =
        function ? function->data().function : projection::defaultTransferFunction();
    if (chosen.extinctionSuggested && !volumeSamples) volumeSamples = mesh::sampleVolume(*drawn);
    if (volumeSamples) use.samples = &*volumeSamples;
    next.transferFunction = projection::resolvedFor(chosen, *drawn, use);
    const bool allCells = drawn->cells.size() == mesh->data().cells.size();
    next.meshMemo = allCells ? mesh->data().memo : nullptr;  // without some cells it is another mesh
    next.frameMemory = memory;
    const std::vector<projection::HalfSpace> clips = renderer::sceneCuts(cuts);
    if (!clips.empty())
        next.mapSources.push_back(std::make_shared<projection::ClipRegion>(
            clips, cutLayer.value_or(projection::cutLayerShare * drawn->bounds.diagonal())));
    projection::OpaqueObjects objects = renderer::sceneObjects(slices, surfaces);
    if (boundary)
        for (projection::OpaqueSurface& surface :
             projection::boundarySurfaces(*drawn, clips, renderer::boundaryLook(*boundary)))
            objects.surfaces.push_back(std::move(surface));
    for (const projection::OpaqueSurface& surface : objects.surfaces)
        if (surface.castsShadows()) next.shadowCasters.push_back(surface.mesh);
    if (!objects.empty()) next.mapSources.push_back(std::make_shared<const projection::OpaqueLayer>(next, objects));
    scene = std::move(next);
    parts = {clips, std::move(objects)};
    engine = projection::makeEngine(scene, {options.engine, options.context});
    made = Tier::Appearance;
}

/// The camera of a smaller picture, where the whole would take longer than the budget. 0: no budget.
projection::Camera Renderer::State::withinBudget(const projection::Camera& view, double budget) const {
    constexpr double share = 0.8;  // of the budget: frames differ
    projection::Camera smaller = view;
    const double pixels = static_cast<double>(view.width) * view.height;
    if (budget > 0 && view.whole == glm::ivec2(0)) {  // a part of a picture has the size that it has
        const double side = std::sqrt(cost.pixelsWithin(share * budget, pixels) / pixels);
        smaller.width = std::clamp(static_cast<int>(view.width * side), 1, view.width);
        smaller.height = std::clamp(static_cast<int>(view.height * side), 1, view.height);
    }
    return smaller;
}

/// The whole picture; within a budget fewer pixels of it, enlarged.
projection::Image Renderer::State::draw(const projection::Camera& view, const Control& control,
                                        const projection::FrameControl& waiting, projection::FrameReport& report) {
    const projection::Camera coarse = withinBudget(view, control.budgetMilliseconds);
    const auto limits = limitsOf(control, coarse, view);
    const auto start = Clock::now();
    projection::Image image = engine->render({coarse, limits ? &*limits : nullptr, &waiting}, report);
    cost.add(static_cast<double>(coarse.width) * coarse.height, millisecondsSince(start));
    maps = report.maps ? report.maps : limits ? std::make_shared<const projection::PixelMaps>(*limits) : nullptr;
    report.drawnWidth = coarse.width;
    report.drawnHeight = coarse.height;
    if (coarse.width == view.width && coarse.height == view.height) return image;
    return projection::resized(image, view.width, view.height);
}

PixelProbe Renderer::State::probe(const projection::Camera& view, int x, int y) {
    const projection::ReferenceRayCaster caster(scene);
    const preint::ExactIntegral exact(scene.transferFunction);
    const projection::Ray ray = projection::pixelRay(projection::cameraFrame(view), x, y);
    PixelProbe probe;
    for (const projection::RaySegment& segment : caster.segmentsAt(view, x, y)) {
        const double alpha = exact
                                 .segment(segment.scalarIn, segment.scalarOut, segment.tOut - segment.tIn,
                                          projection::integralOf(scene.settings.mode))
                                 .opacity();
        probe.segments.push_back({segment.tIn, segment.tOut, segment.scalarIn, segment.scalarOut, alpha});
        if (probe.hit || !(alpha > 0)) continue;
        probe.hit = true;
        probe.distance = projection::firstShownAt(exact, segment).value_or(segment.tIn);
        const double share =
            segment.tOut > segment.tIn ? (probe.distance - segment.tIn) / (segment.tOut - segment.tIn) : 0.0;
        probe.scalar = std::lerp(segment.scalarIn, segment.scalarOut, share);
        const glm::dvec3 place = ray.origin + probe.distance * ray.direction;
        probe.position = renderer::arrayOf(place);
    }
    return probe;
}

Renderer::Renderer(std::shared_ptr<const Mesh> mesh, RendererOptions options) : state_(std::make_unique<State>()) {
    if (!mesh) throw Error(Errc::BadInput, "renderer: no mesh; make one with Mesh::fromTetrahedra or Mesh::fromCells");
    if (options.threads < 0)
        throw Error(Errc::BadInput, fmt::format("renderer: {} threads; give 1 or more, or 0 for all", options.threads));
    const auto names = projection::engineNames();
    if (options.engine != "auto" && std::find(names.begin(), names.end(), options.engine) == names.end())
        throw Error(Errc::BadInput,
                    fmt::format("renderer: there is no engine '{}'; engines() lists them", options.engine));
    state_->mesh = std::move(mesh);
    state_->options = std::move(options);
    if (!state_->options.arena)
        state_->arena =
            std::make_unique<tbb::task_arena>(state_->options.threads > 0  // more than there are only makes oneTBB warn
                                                  ? std::min(state_->options.threads, tbb::info::default_concurrency())
                                                  : int{tbb::task_arena::automatic});
}

Renderer::~Renderer() = default;
Renderer::Renderer(Renderer&&) noexcept = default;
Renderer& Renderer::operator=(Renderer&&) noexcept = default;

void Renderer::setField(Field field) {
    state_->field = std::move(field);
    state_->changed(State::Tier::Nothing);
}
void Renderer::setTransferFunction(std::optional<TransferFunction> function) {
    state_->function = std::move(function);
    state_->changed(State::Tier::Field);
}
void Renderer::setMode(Mode mode) {
    state_->mode = mode;
    state_->changed(State::Tier::Field);
}
void Renderer::setLighting(Lighting lighting) {
    state_->lighting = renderer::translated([&] { return renderer::sceneLighting(lighting); });
    state_->changed(State::Tier::Field);
}
void Renderer::setLighting(std::string_view document) {
    shading::ShadingSettings lighting;
    renderer::translated([&] { projection::parseLighting(std::string(document), "lighting", lighting); });
    state_->lighting = std::move(lighting);
    state_->changed(State::Tier::Field);
}
void Renderer::setSamples(int samples) {
    if (samples < 1 || samples > 64)
        throw Error(Errc::BadInput, fmt::format("samples: {} rays a pixel; give 1 to 64", samples));
    state_->pixelSamples = samples;
    state_->changed(State::Tier::Field);
}
void Renderer::setSilhouettes(Silhouettes silhouettes) {
    state_->silhouettes = silhouettes;
    state_->changed(State::Tier::Field);
}
void Renderer::setCuts(std::vector<Cut> cuts, std::optional<double> layer) {
    if (layer && !(*layer >= 0 && std::isfinite(*layer)))
        throw Error(Errc::BadInput, fmt::format("cuts: a layer of {} mesh units; give a length from 0", *layer));
    state_->cuts = std::move(cuts);
    state_->cutLayer = layer;
    state_->changed(State::Tier::Field);
}
void Renderer::setSlices(std::vector<Slice> slices) {
    state_->slices = std::move(slices);
    state_->changed(State::Tier::Field);
}
void Renderer::setSurfaces(std::vector<Surface> surfaces) {
    state_->surfaces = std::move(surfaces);
    state_->changed(State::Tier::Field);
}

void Renderer::setBoundary(std::optional<Boundary> boundary) {
    state_->boundary = std::move(boundary);
    state_->changed(State::Tier::Field);
}

Camera Renderer::fittedCamera(const FittedView& view, int width, int height) {
    return renderer::translated([&] {
        State& state = *state_;
        projection::Camera fitted;
        state.run([&] {
            state.make();
            const auto points = projection::shownPoints(state.scene, state.parts, !view.wholeMesh);
            if (points.empty())
                throw Error(Errc::BadInput,
                            fmt::format("view: {}", projection::whyEmpty(state.scene, state.parts, {})));
            fitted = renderer::fittedSceneCamera(view, points, width, height);
        });
        return renderer::publicCamera(fitted);
    });
}

FrameResult Renderer::render(const Camera& camera, ImageView image, const Control& control) {
    return renderer::translated([&] {
        checkView(image);
        State& state = *state_;
        const auto start = Clock::now();
        FrameResult result;
        projection::FrameReport report;
        const projection::FrameControl waiting{control.stop, control.progress};
        if (control.progress) control.progress(0.0);
        const projection::Camera view = renderer::sceneCamera(camera, image, control.tile);
        std::optional<projection::Image> picture;
        try {
            state.run([&] {
                waiting.check();
                projection::cameraFrame(view);  // refuses now rather than after preparing
                if (control.depthLimit != nullptr) checkDepthLimit(control.depthLimit, view);
                if (state.made < State::Tier::Appearance) state.cost.forget();
                state.make();
                waiting.check();
                picture = state.draw(view, control, waiting, report);
                state.camera = view;
                if (projection::isEmpty(*picture))
                    result.emptyBecause = projection::whyEmpty(state.scene, state.parts, view);
            });
        } catch (const projection::FrameStopped&) {
            picture.reset();
        }
        result.complete = picture.has_value();
        copyTo(image, picture ? *picture : projection::Image(image.width, image.height));
        result.cellsDrawn = report.cellsDrawn;
        result.cellsSkipped = std::move(report.cellsSkipped);
        if (state.withoutScalar > 0)
            result.cellsSkipped[mesh::defectName(mesh::Defect::NonFiniteScalar)] += state.withoutScalar;
        result.pixelsRepaired = report.pixelsRepaired;
        result.pixelsWrong = report.pixelsWrong;
        result.stageMilliseconds = std::move(report.stageMilliseconds);
        result.drawnWidth = report.drawnWidth;
        result.drawnHeight = report.drawnHeight;
        result.milliseconds = millisecondsSince(start);
        if (control.progress && result.complete) control.progress(1.0);
        return result;
    });
}

Verification Renderer::verify(const Camera& camera, ImageView image, std::size_t pixels) {
    return renderer::translated([&] {
        checkView(image);
        State& state = *state_;
        projection::Camera view = renderer::sceneCamera(camera, image, {});
        view.tile = state.camera.tile;
        view.whole = state.camera.whole;
        if (state.made < State::Tier::Appearance || !(view == state.camera))
            throw Error(Errc::BadInput, "verify: not the last frame; render it with this camera and size first");
        projection::Verification found;
        state.run([&] {
            found =
                projection::verifyImage(copyOf(image), state.scene, {view, state.maps.get()}, pixels, verificationSeed);
        });
        return Verification{found.pixels, found.rmse, found.rmseBound, found.max, found.unseenShare()};
    });
}

PixelProbe Renderer::probe(const Camera& camera, int x, int y) {
    return renderer::translated([&] {
        State& state = *state_;
        if (state.camera.width <= 0 || state.made == State::Tier::Nothing)
            throw Error(Errc::BadInput, "probe: there was no frame yet; render one, whose size tells where pixels are");
        ImageView size;
        size.width = state.camera.width;
        size.height = state.camera.height;
        if (x < 0 || y < 0 || x >= size.width || y >= size.height)
            throw Error(Errc::BadInput,
                        fmt::format("probe: pixel {},{} lies outside {}x{}", x, y, size.width, size.height));
        PixelProbe found;
        state.run([&] {
            state.make();
            found = state.probe(renderer::sceneCamera(camera, size, {}), x, y);
        });
        return found;
    });
}

std::string Renderer::engine() const {
    return state_->engine ? state_->engine->name() : state_->options.engine;
}

std::string Renderer::renderer() const {
    std::string name;
    if (state_->engine) state_->run([&] { name = state_->engine->renderer(); });
    return name;
}

std::vector<EngineInfo> engines() {
    std::vector<EngineInfo> result;
    for (const std::string& name : projection::engineNames()) {
        EngineInfo info{name, true, {}};
        try {
            mesh::ScalarMesh one;
            one.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
            one.cells = {{0, 1, 2, 3}};
            one.scalars = {0, 1, 1, 1};
            one.scalarMax = 1;
            one.bounds.high = glm::dvec3(1);
            projection::Scene scene;
            scene.mesh = std::make_shared<const mesh::ScalarMesh>(std::move(one));
            scene.transferFunction = preint::resolved(preint::preset("grayscale"), 0, 1, 1);
            projection::makeEngine(scene, {name});
        } catch (const std::exception& error) {
            info.available = false;
            info.whyNot = error.what();
        }
        result.push_back(std::move(info));
    }
    return result;
}

}  // namespace tetralux
