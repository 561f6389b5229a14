// SPDX-License-Identifier: Apache-2.0
#include <apps/render_scene.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include <fmt/format.h>

#include <apps/film/film_writer.h>
#include <apps/stopwatch.h>
#include <mesh/io/nearest_time.h>
#include <mesh/io/read_mesh.h>
#include <mesh/tet/interface_checks.h>
#include <mesh/tet/procedural_field.h>
#include <preint/equidistant_isosurfaces.h>
#include <preint/transfer_function.h>
#include <projection/frame/engine_registry.h>
#include <projection/frame/function_advice.h>
#include <projection/frame/sampled_engine.h>
#include <projection/frame/suggested_extinction.h>
#include <projection/light/light_frame.h>
#include <projection/opaque/boundary_surface.h>
#include <projection/opaque/opaque_layer.h>

namespace tetralux::apps {

namespace {

constexpr std::uint32_t verificationSeed = 1;  // the same pixels in every run

projection::FunctionUse useOf(const RenderOptions& options) {
    projection::FunctionUse use;
    use.mode = options.settings.mode;
    use.perScalar = options.shape.isosurfaces.has_value();  // they have no length, whatever the mode
    return use;
}

/// What is put under the picture when nothing is said.
std::optional<glm::vec3> ownBackground(projection::Mode mode) {
    if (mode == projection::Mode::Absorption) return glm::vec3(1.0f);  // a radiograph is black without light behind it
    return std::nullopt;
}

}  // namespace

SceneRenderer::SceneRenderer(const RenderOptions& options) {
    change(options, Change::Mesh);
}

void SceneRenderer::change(const RenderOptions& options, Change change) {
    if (change == Change::Camera) {
        options_.camera = options.camera;
        return placeCamera();
    }
    takeLook(options);
    if (change == Change::Mesh) {
        engine_.reset();  // of a mesh that may be another one's from here on
        record_.step.reset();
        readStep(options_.read.time);
    }
    if (options_.colors.rangeOfAllSteps && times_.size() > 1) function_.range = rangeOfAllSteps();
    const Stopwatch watch;
    makeLook();
    record_.prepareMilliseconds = watch.milliseconds();
}

void SceneRenderer::takeLook(const RenderOptions& options) {
    function_ = transferFunctionFor(options.colors);
    givenObjects_ = readOpaqueObjects(options.opaque);
    options_ = options;
    options_.camera.orbits = options.frames.has_value();
    annotation_ = options.annotation;
    background_ = options.background.value_or(ownBackground(options.settings.mode));
    keepsNumbers_ = options.output != "-" && !isFilm(options.output) && projection::holdsNumbers(options.output);
    givenObjects_.isolines.width *= projection::samplesPerAxis(options.settings.samples);  // samples are pixels there
}

void SceneRenderer::makeLook() {
    engine_.reset();  // what it leaves behind the next one takes
    makeScene();
    placeCamera();
    engine_ = projection::makeEngine(scene_, options_.engine);
}

void SceneRenderer::placeCamera() {
    record_.camera =
        cameraFor(options_.camera, scene_, parts_,
                  marginsFor(options_.annotation, annotated_, options_.camera.size.x, options_.camera.size.y),
                  options_.annotation.axes);
}

projection::Image SceneRenderer::draw(const projection::View& view, projection::FrameReport& report) const {
    const Stopwatch watch;
    projection::Image image = engine_->render(view, report);
    report.frameMilliseconds = watch.milliseconds();
    return image;
}

std::string SceneRenderer::whyEmpty(const projection::Camera& camera) const {
    return projection::whyEmpty(scene_, parts_, camera);
}

void SceneRenderer::moveTo(std::size_t step) {
    if (record_.step && record_.step->number == step) return;
    readStep(times_.at(step));
    engine_.reset();  // what it leaves behind the next one takes
    makeScene();
    engine_ = projection::makeEngine(scene_, options_.engine);
}

void SceneRenderer::readStep(std::optional<double> time) {
    const Stopwatch watch;
    mesh::ReadOptions read = options_.read;
    read.time = time;
    mesh::ReadResult source = mesh::readMesh(options_.source, read);
    times_ = source.times;
    if (!times_.empty()) {
        const double drawn = mesh::nearestTime(times_, time);
        const auto at = std::find(times_.begin(), times_.end(), drawn);
        record_.step = DrawnStep{drawn, static_cast<std::size_t>(at - times_.begin()), times_.size()};
    }
    try {
        mesh::shapeMesh(source, options_.shaping);
        record_.mesh = std::move(source.report);
        anisotropy_.emplace(options_, source.mesh);
        mesh::ScalarSelection selection = mesh::selectScalar(std::move(source.mesh), options_.scalar, record_.mesh);
        record_.fieldName = selection.fieldName;
        takeMesh(std::move(selection.mesh));
        anisotropy_->find(*scene_.mesh, record_.fieldName);
    } catch (const std::runtime_error& error) {
        throw std::runtime_error(fmt::format("{}: {}", options_.source, error.what()));
    }
    record_.readMilliseconds += watch.milliseconds();
    if (!record_.meshKept) checkInterfaces(options_);
    record_.scalarMin = scene_.mesh->scalarMin;
    record_.scalarMax = scene_.mesh->scalarMax;
    record_.tetrahedra = scene_.mesh->cells.size();
}

/// With the arrays of the last step's where it has the same points and cells.
void SceneRenderer::takeMesh(mesh::ScalarMesh mesh) {
    const mesh::ScalarMesh* const before = scene_.mesh.get();
    record_.meshKept = before != nullptr && before->positions == mesh.positions && before->cells == mesh.cells;
    if (record_.meshKept) {
        mesh.positions = before->positions;
        mesh.cells = before->cells;
    } else {
        meshMemo_ = std::make_shared<projection::MeshMemo>();
    }
    scene_.mesh = std::make_shared<const mesh::ScalarMesh>(std::move(mesh));
}

/// Reads every step once.
glm::dvec2 SceneRenderer::rangeOfAllSteps() {
    glm::dvec2 range(record_.scalarMin, record_.scalarMax);
    for (const double time : times_) {
        mesh::ReadOptions read = options_.read;
        read.time = time;
        mesh::ReadResult source = mesh::readMesh(options_.source, read);
        mesh::MeshReport ignored;
        mesh::shapeMesh(source, options_.shaping);
        const mesh::ScalarSelection step = mesh::selectScalar(std::move(source.mesh), options_.scalar, ignored);
        range = {std::min(range.x, step.mesh.scalarMin), std::max(range.y, step.mesh.scalarMax)};
    }
    return range;
}

void SceneRenderer::makeScene() {
    projection::Scene next;
    next.mesh = scene_.mesh;
    next.settings = options_.settings;
    next.meshMemo = meshMemo_;
    next.frameMemory = frameMemory_;
    try {
        next.transferFunction = projection::resolvedFor(function_, *next.mesh, useOf(options_));
    } catch (const std::runtime_error& error) {
        throw std::runtime_error(fmt::format("{}: {}: {}", options_.source, record_.fieldName, error.what()));
    }
    if (options_.shape.isosurfaces)
        next.transferFunction = preint::equidistantIsosurfaces(next.transferFunction, *options_.shape.isosurfaces,
                                                               record_.scalarMin, record_.scalarMax);
    const glm::dvec2 range = projection::shownRange(function_, *next.mesh);
    annotated_ = {record_.fieldName,
                  range.x,
                  range.y,
                  next.transferFunction,
                  next.mesh->bounds,
                  function_.logarithmic,
                  function_.categories.empty() ? std::vector<double>{} : projection::fewValues(*next.mesh),
                  glm::dvec3(background_.value_or(glm::vec3(0)))};
    projection::OpaqueObjects opaque = givenObjects_;
    if (options_.opaque.isolines)
        opaque.isolines.values = preint::equidistantValues(*options_.opaque.isolines, range.x, range.y);
    if (options_.opaque.boundary) {
        projection::BoundaryLook look = options_.opaque.boundaryLook;
        look.flat = options_.opaque.flat;
        for (projection::OpaqueSurface& surface : projection::boundarySurfaces(*next.mesh, options_.shape.clips, look))
            opaque.surfaces.push_back(std::move(surface));
    }
    // limits come first: they leave out parts of slices
    if (!options_.shape.clips.empty())
        next.mapSources.push_back(std::make_shared<projection::ClipRegion>(
            options_.shape.clips,
            options_.shape.cutLayer.value_or(projection::cutLayerShare * next.mesh->bounds.diagonal())));
    for (const projection::OpaqueSurface& surface : opaque.surfaces)
        if (surface.castsShadows()) next.shadowCasters.push_back(surface.mesh);
    if (!opaque.empty()) next.mapSources.push_back(std::make_shared<const projection::OpaqueLayer>(next, opaque));
    parts_ = {options_.shape.clips, std::move(opaque)};
    if (anisotropy_->tensors() && next.settings.shading.needsAnisotropy())
        next = projection::withVertexLight(std::move(next), anisotropy_->tensors());
    scene_ = std::move(next);
}

/// Up to so many tetrahedra and boundary faces it takes some 30 ms; a generated grid is known to fit together.
void SceneRenderer::checkInterfaces(const RenderOptions& options) {
    const bool always = options.checkInterfaces;
    record_.interfacesChecked = mesh::parseProceduralSource(options.source).has_value();
    if (record_.interfacesChecked && !always) return;
    constexpr std::size_t mostCells = 250'000, mostBoundaryFaces = 100'000;
    const mesh::ScalarMesh& cells = *scene_.mesh;
    if (!always && cells.cells.size() > mostCells) return;
    const Stopwatch watch;
    const mesh::Adjacency adjacency = mesh::buildAdjacency(cells.cells, cells.positions.size());
    if (!always && adjacency.boundaryFaces > mostBoundaryFaces) return;
    record_.mesh.defects.merge(mesh::interfaceDefects(cells.positions, cells.cells, adjacency));
    record_.interfacesChecked = true;
    record_.checkMilliseconds = watch.milliseconds();
}

/// Keeps what was found in the frame that may be farthest from the truth.
void SceneRenderer::verify(const projection::Image& image, const projection::View& view) {
    const auto found = projection::verifyImage(image, scene_, view, static_cast<std::size_t>(options_.verifiedPixels),
                                               verificationSeed);
    if (!record_.verification || !(found.rmseBound <= record_.verification->rmseBound)) record_.verification = found;
}

/// The map of contributions holds their numbers; where a file cannot, it shows them as shares of the largest.
void SceneRenderer::showCounts(projection::Image& image) {
    float most = 0.0f;
    for (const glm::vec4& pixel : image.pixels) most = std::max(most, pixel.x);
    record_.mostContributions = std::max(record_.mostContributions.value_or(0.0f), most);
    if (keepsNumbers_ || !(most > 0.0f)) return;
    for (glm::vec4& pixel : image.pixels) pixel = glm::vec4(glm::vec3(pixel) / most, pixel.a);
}

projection::Image SceneRenderer::render(double turn) {
    const projection::Camera camera =
        turn == 0.0 ? record_.camera : projection::orbited(record_.camera, 2.0 * std::numbers::pi * turn);
    projection::FrameReport report;
    projection::Image image = draw({camera}, report);
    if (projection::isEmpty(image)) record_.emptyBecause = whyEmpty(camera);
    if (options_.verifiedPixels > 0) verify(image, {camera, report.maps.get()});
    report.maps.reset();  // a picture's worth of memory
    if (scene_.settings.mode == projection::Mode::Contributions) showCounts(image);
    record_.frames.push_back(std::move(report));
    return finished(std::move(image), camera);
}

projection::Image SceneRenderer::preview(double promisedMilliseconds) {
    projection::PreviewRenderer renderer(scene_, options_.engine, *engine_);
    record_.preview = renderer.render(record_.camera, promisedMilliseconds);
    return finished(std::move(record_.preview->image), record_.camera);
}

std::string SceneRenderer::advice() const {
    return function_.extinctionSuggested || function_.range ? "" : projection::functionAdvice(scene_);
}

/// "{time}" and "{step}" in a title are those of the step.
std::string SceneRenderer::title() const {
    std::string text = options_.annotation.title;
    const auto replace = [&](const std::string& word, const std::string& value) {
        for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + value.size()))
            text.replace(at, word.size(), value);
    };
    if (record_.step) {
        replace("{time}", fmt::format("{:.6g}", record_.step->time));
        replace("{step}", std::to_string(record_.step->number));
    }
    return text;
}

projection::Image SceneRenderer::finished(projection::Image image, const projection::Camera& camera) const {
    AnnotationOptions annotation = annotation_;
    annotation.title = title();
    drawBehind(annotation, annotated_, camera, image);
    if (background_) projection::putUnder(image, *background_);
    drawInFront(annotation, annotated_, camera, image);
    return image;
}

}  // namespace tetralux::apps
