// SPDX-License-Identifier: Apache-2.0
#include <projection/frame/engine_registry.h>
#include <projection/frame/preview.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include <mesh/tet/coarse_mesh.h>

namespace tetralux::projection {

namespace {

using Clock = std::chrono::steady_clock;

constexpr double aim = 0.7;           // of the promised time: frames of one scene differ by some tens of per cent
constexpr double largestBase = 0.35;  // of the promised time; above it a coarser mesh leaves more for pixels
constexpr int attempts = 5;
constexpr int leastSide = 16;                  // pixels of the longer side
constexpr int gridSizes[] = {48, 32, 20, 12};  // points along each edge

double millisecondsSince(Clock::time_point start) {
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

/// The same view in about `share` of the pixels.
Camera smaller(const Camera& camera, double share) {
    const double side = std::sqrt(std::min(share, 1.0));
    Camera result = camera;
    result.width = std::clamp(static_cast<int>(camera.width * side), 1, camera.width);
    result.height = std::clamp(static_cast<int>(camera.height * side), 1, camera.height);
    return result;
}

double pixelsOf(const Camera& camera) {
    return static_cast<double>(camera.width) * camera.height;
}

}  // namespace

PreviewRenderer::PreviewRenderer(const Scene& scene, const EngineOptions& options, Engine& engine)
    : scene_(scene), options_(options), engine_(&engine) {}

PreviewRenderer::Cost PreviewRenderer::measure(const Camera& camera) {
    const auto timeOf = [&](const Camera& view) {
        double best = 1e300;
        for (int i = 0; i < 2; ++i) {  // the first frame of an engine also makes what later ones keep
            FrameReport report;
            const auto start = Clock::now();
            engine_->render(view, report);
            best = std::min(best, millisecondsSince(start));
        }
        return best;
    };
    const Camera small = smaller(camera, 1.0 / 256), large = smaller(camera, 1.0 / 32);
    const double first = timeOf(small), second = timeOf(large);
    const double pixels = pixelsOf(large) - pixelsOf(small);
    const double perPixel = pixels > 0 ? std::max(0.0, (second - first) / pixels) : 0.0;
    return {std::max(0.0, first - perPixel * pixelsOf(small)), perPixel};
}

void PreviewRenderer::coarsen(const Camera& camera, double promisedMilliseconds, Cost& cost) {
    for (const int n : gridSizes) {
        if (cost.base <= largestBase * promisedMilliseconds) return;
        // five cells per box: no gain where the mesh has no more
        if (5.0 * n * n * n > 0.5 * static_cast<double>(scene_.mesh->cells.size())) continue;
        auto mesh = std::make_shared<const mesh::ScalarMesh>(mesh::coarseMesh(*scene_.mesh, n));
        if (mesh->cells.empty()) return;
        Scene scene = scene_;
        scene.mesh = std::move(mesh);
        scene.vertexLight.reset();  // of other points
        coarse_ = makeEngine(scene, options_);
        engine_ = coarse_.get();
        gridPoints_ = n;
        cost = measure(camera);
    }
}

Preview PreviewRenderer::render(const Camera& camera, double promisedMilliseconds) {
    if (!(promisedMilliseconds > 0))
        throw std::runtime_error(
            fmt::format("preview: {} ms will not do; promise a time above 0", promisedMilliseconds));
    Cost cost = measure(camera);
    coarsen(camera, promisedMilliseconds, cost);

    const double least =
        std::min(1.0, std::pow(leastSide / static_cast<double>(std::max(camera.width, camera.height)), 2));
    double share = 1.0;
    if (cost.base + cost.perPixel * pixelsOf(camera) > aim * promisedMilliseconds && cost.perPixel > 0)
        share = (aim * promisedMilliseconds - cost.base) / (cost.perPixel * pixelsOf(camera));
    Preview best;
    for (int attempt = 0; attempt < attempts; ++attempt) {
        share = std::clamp(share, least, 1.0);
        Preview preview = attemptOf(smaller(camera, share), camera, promisedMilliseconds);
        const bool better = preview.kept ? !best.kept || preview.width > best.width : !best.kept;
        const double used = preview.frameMilliseconds / promisedMilliseconds;
        if (better) best = preview;
        // too long, or less than half of the time was used though there are pixels left to draw
        if (best.kept && (used > 0.5 || share >= 1.0)) break;
        // by the same model, through this frame's time
        const double wanted = aim * promisedMilliseconds - cost.base, spent = preview.frameMilliseconds - cost.base;
        share *= wanted > 0 && spent > 0 ? std::clamp(wanted / spent, 0.25, 4.0) : used > aim ? 0.5 : 4.0;
    }
    return best;
}

Preview PreviewRenderer::attemptOf(const Camera& view, const Camera& whole, double promisedMilliseconds) {
    Preview preview;
    FrameReport report;
    const auto start = Clock::now();
    preview.image = resized(engine_->render(view, report), whole.width, whole.height);
    preview.frameMilliseconds = millisecondsSince(start);
    preview.width = view.width;
    preview.height = view.height;
    preview.gridPoints = gridPoints_;
    preview.kept = preview.frameMilliseconds <= promisedMilliseconds;
    return preview;
}

}  // namespace tetralux::projection
