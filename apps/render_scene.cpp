// SPDX-License-Identifier: Apache-2.0
#include <apps/render_scene.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include <fmt/format.h>

#include <apps/kept_anisotropy.h>
#include <apps/stopwatch.h>
#include <mesh/io/read_mesh.h>
#include <mesh/tet/interface_checks.h>
#include <mesh/tet/procedural_field.h>
#include <preint/equidistant_isosurfaces.h>
#include <preint/transfer_function.h>
#include <projection/frame/engine_registry.h>
#include <projection/frame/sampled_engine.h>
#include <projection/frame/suggested_extinction.h>
#include <projection/light/light_frame.h>
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

projection::Camera cameraFor(const RenderOptions& options, const mesh::BoundingBox& bounds) {
    projection::Camera camera;
    camera.width = options.size.x;
    camera.height = options.size.y;
    camera.fovDegrees = options.fovDegrees;
    camera.orthographicHeight = options.orthographicHeight;
    camera.up = options.up.value_or(camera.up);
    camera.target = options.target.value_or(bounds.centre());
    camera.eye = options.eye ? *options.eye : projection::threeQuarterEye(bounds, camera);
    constexpr double roomForNumbers = 1.25;
    if (!options.eye && options.annotation.axes) camera.eye += (roomForNumbers - 1.0) * (camera.eye - bounds.centre());
    projection::cameraFrame(camera);  // throws now rather than after preparing
    return camera;
}

/// What is put under the picture when nothing is said.
std::optional<glm::vec3> ownBackground(projection::Mode mode) {
    if (mode == projection::Mode::Absorption) return glm::vec3(1.0f);  // a radiograph is black without light behind it
    return std::nullopt;
}

}  // namespace

SceneRenderer::SceneRenderer(const RenderOptions& options)
    : engineOptions_(options.engine),
      annotation_(options.annotation),
      background_(options.background.value_or(ownBackground(options.settings.mode))),
      verifiedPixels_(options.verifiedPixels),
      keepsNumbers_(projection::holdsNumbers(options.output)) {
    readScene(options);
    const Stopwatch watch;
    record_.camera = cameraFor(options, scene_.mesh->bounds);
    engine_ = projection::makeEngine(scene_, options.engine);
    record_.prepareMilliseconds = watch.milliseconds();
}

void SceneRenderer::readScene(const RenderOptions& options) {
    const preint::TransferFunction transferFunction = transferFunctionFor(options.colors);
    projection::OpaqueObjects opaque = readOpaqueObjects(options.opaque);
    const Stopwatch watch;
    mesh::ReadResult source = mesh::readMesh(options.source, options.read);
    record_.mesh = std::move(source.report);
    KeptAnisotropy anisotropy(options, source.mesh);
    try {
        mesh::ScalarSelection selection = mesh::selectScalar(std::move(source.mesh), options.scalar, record_.mesh);
        record_.fieldName = selection.fieldName;
        scene_.mesh = std::make_shared<const mesh::ScalarMesh>(std::move(selection.mesh));
        anisotropy.find(*scene_.mesh, record_.fieldName);
    } catch (const std::runtime_error& error) {
        throw std::runtime_error(fmt::format("{}: {}", options.source, error.what()));
    }
    record_.readMilliseconds = watch.milliseconds();
    checkInterfaces(options);

    record_.scalarMin = scene_.mesh->scalarMin;
    record_.scalarMax = scene_.mesh->scalarMax;
    record_.tetrahedra = scene_.mesh->cells.size();
    scene_.settings = options.settings;
    try {
        scene_.transferFunction = projection::resolvedFor(transferFunction, *scene_.mesh, useOf(options));
    } catch (const std::runtime_error& error) {
        throw std::runtime_error(fmt::format("{}: {}: {}", options.source, record_.fieldName, error.what()));
    }
    if (options.shape.isosurfaces)
        scene_.transferFunction = preint::equidistantIsosurfaces(scene_.transferFunction, *options.shape.isosurfaces,
                                                                 record_.scalarMin, record_.scalarMax);
    const glm::dvec2 range = projection::shownRange(transferFunction, *scene_.mesh);
    annotated_ = {record_.fieldName,
                  range.x,
                  range.y,
                  scene_.transferFunction,
                  scene_.mesh->bounds,
                  transferFunction.logarithmic,
                  transferFunction.categories.empty() ? std::vector<double>{} : projection::fewValues(*scene_.mesh),
                  glm::dvec3(background_.value_or(glm::vec3(0)))};
    opaque.isolines.width *= projection::samplesPerAxis(options.settings.samples);  // samples are pixels there
    if (options.opaque.isolines)
        opaque.isolines.values = preint::equidistantValues(*options.opaque.isolines, range.x, range.y);
    // limits come first: they leave out parts of slices
    if (!options.shape.clips.empty())
        scene_.mapSources.push_back(std::make_shared<projection::ClipRegion>(
            options.shape.clips,
            options.shape.cutLayer.value_or(projection::cutLayerShare * scene_.mesh->bounds.diagonal())));
    for (const projection::OpaqueSurface& surface : opaque.surfaces) scene_.shadowCasters.push_back(surface.mesh);
    if (!opaque.empty()) scene_.mapSources.push_back(std::make_shared<const projection::OpaqueLayer>(scene_, opaque));
    if (anisotropy.tensors() && scene_.settings.shading.needsAnisotropy())
        scene_ = projection::withVertexLight(std::move(scene_), anisotropy.tensors());
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
    const auto found =
        projection::verifyImage(image, scene_, view, static_cast<std::size_t>(verifiedPixels_), verificationSeed);
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
    const Stopwatch watch;
    projection::Image image = engine_->render(camera, report);
    report.frameMilliseconds = watch.milliseconds();
    if (verifiedPixels_ > 0) verify(image, {camera, report.maps.get()});
    report.maps.reset();  // a picture's worth of memory
    if (scene_.settings.mode == projection::Mode::Contributions) showCounts(image);
    record_.frames.push_back(std::move(report));
    return finished(std::move(image), camera);
}

projection::Image SceneRenderer::preview(double promisedMilliseconds) {
    projection::PreviewRenderer renderer(scene_, engineOptions_, *engine_);
    record_.preview = renderer.render(record_.camera, promisedMilliseconds);
    return finished(std::move(record_.preview->image), record_.camera);
}

projection::Image SceneRenderer::finished(projection::Image image, const projection::Camera& camera) const {
    drawBehind(annotation_, annotated_, camera, image);
    if (background_) projection::putUnder(image, *background_);
    drawInFront(annotation_, annotated_, camera, image);
    return image;
}

}  // namespace tetralux::apps
