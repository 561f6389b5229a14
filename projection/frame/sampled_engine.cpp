// SPDX-License-Identifier: Apache-2.0
#include <projection/frame/sampled_engine.h>

#include <algorithm>
#include <chrono>
#include <utility>

#include <tbb/parallel_for.h>

#include <projection/core/wrapped_engine.h>
#include <projection/frame/adaptive_opacity.h>
#include <projection/reference/reference_ray_caster.h>

namespace tetralux::projection {

namespace {

/// Places of samples among those of the larger picture.
struct SampleGrid {
    std::size_t width, perAxis;  ///< of the picture, in pixels

    std::size_t of(std::size_t x, std::size_t y, std::size_t i, std::size_t j) const {
        return (y * perAxis + j) * width * perAxis + x * perAxis + i;
    }
    template <class Function>
    void ofPixel(std::size_t pixel, Function function) const {
        for (std::size_t j = 0; j < perAxis; ++j)
            for (std::size_t i = 0; i < perAxis; ++i) function(of(pixel % width, pixel / width, i, j));
    }
    glm::vec4 mean(const Image& samples, std::size_t pixel) const {
        glm::dvec4 sum(0);
        ofPixel(pixel, [&](std::size_t sample) { sum += glm::dvec4(samples.pixels[sample]); });
        return glm::vec4(sum / static_cast<double>(perAxis * perAxis));
    }
};

SampleGrid gridOf(const Camera& camera, int perAxis) {
    return {static_cast<std::size_t>(camera.width), static_cast<std::size_t>(perAxis)};
}

/// What holds for a pixel holds for its samples.
PixelMaps mapsOfSamples(const PixelMaps& maps, const Camera& camera, int perAxis) {
    const SampleGrid grid = gridOf(camera, perAxis);
    const std::size_t pixels = grid.width * static_cast<std::size_t>(camera.height);
    PixelMaps result;
    const auto spread = [&](const auto& from, auto& to) {
        if (from.empty()) return;
        to.resize(pixels * grid.perAxis * grid.perAxis);
        for (std::size_t pixel = 0; pixel < pixels; ++pixel)
            grid.ofPixel(pixel, [&](std::size_t sample) { to[sample] = from[pixel]; });
    };
    spread(maps.nearest, result.nearest);
    spread(maps.farthest, result.farthest);
    spread(maps.cutLayerEnd, result.cutLayerEnd);
    spread(maps.cutNormal, result.cutNormal);
    spread(maps.extinctionScale, result.extinctionScale);
    spread(maps.behind, result.behind);
    for (const TranslucentFragment& fragment : maps.translucent)
        grid.ofPixel(fragment.pixel, [&](std::size_t sample) {
            result.translucent.push_back(fragment);
            result.translucent.back().pixel = static_cast<std::uint32_t>(sample);
        });
    std::sort(result.translucent.begin(), result.translucent.end());
    return result;
}

class SampledEngine final : public WrappedEngine {
public:
    SampledEngine(std::unique_ptr<Engine> engine, int perAxis) : WrappedEngine(std::move(engine)), perAxis_(perAxis) {}

    Image render(const View& view, FrameReport& report) override {
        PixelMaps maps;
        if (view.maps != nullptr) {
            checkPixelMaps(view);
            maps = mapsOfSamples(*view.maps, view.camera, perAxis_);
        }
        const Image samples = engine_->render(
            {sampledCamera(view.camera, perAxis_), view.maps != nullptr ? &maps : nullptr, view.control}, report);
        const auto start = std::chrono::steady_clock::now();
        Image image(view.camera.width, view.camera.height);
        const SampleGrid grid = gridOf(view.camera, perAxis_);
        tbb::parallel_for(std::size_t{0}, static_cast<std::size_t>(image.height), [&](std::size_t y) {
            for (std::size_t x = 0; x < grid.width; ++x)
                image.pixels[y * grid.width + x] = grid.mean(samples, y * grid.width + x);
        });
        const double spent =
            std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
        report.stageMilliseconds["average"] += spent;
        report.frameMilliseconds += spent;
        return image;
    }

private:
    int perAxis_;
};

/// Pixels of a scene with one sample each.
void castSamples(const Scene& scene, const View& view, const std::vector<std::uint32_t>& pixels, Image& image) {
    if (isAdaptive(scene.settings))
        castAdaptivePixels(scene, view, pixels, image);
    else
        ReferenceRayCaster(scene).renderPixels(view, pixels, image);
    if (view.maps != nullptr) composeBehind(image, *view.maps);
}

}  // namespace

int samplesPerAxis(int samples) {
    int perAxis = 1;
    while (perAxis * perAxis < samples) ++perAxis;
    return perAxis;
}

Camera sampledCamera(const Camera& camera, int perAxis) {
    Camera result = camera;
    result.width *= perAxis;
    result.height *= perAxis;
    result.tile *= perAxis;
    result.whole *= perAxis;
    return result;
}

Scene sceneOfSamples(const Scene& scene) {
    Scene result = scene;
    if (result.settings.adaptive) result.settings.adaptive->sigma *= samplesPerAxis(scene.settings.samples);
    result.settings.samples = 1;
    return result;
}

std::unique_ptr<Engine> withSamples(std::unique_ptr<Engine> engine, const Scene& scene) {
    const int perAxis = samplesPerAxis(scene.settings.samples);
    if (perAxis == 1) return engine;
    return std::make_unique<SampledEngine>(std::move(engine), perAxis);
}

void castPixels(const Scene& scene, const Camera& camera, const PixelMaps* maps,
                const std::vector<std::uint32_t>& pixels, Image& image) {
    const int perAxis = samplesPerAxis(scene.settings.samples);
    if (perAxis == 1) return castSamples(scene, {camera, maps}, pixels, image);
    const SampleGrid grid = gridOf(camera, perAxis);
    std::vector<std::uint32_t> samples;
    for (const std::uint32_t pixel : pixels)
        grid.ofPixel(pixel, [&](std::size_t sample) { samples.push_back(static_cast<std::uint32_t>(sample)); });
    std::sort(samples.begin(), samples.end());
    const Camera larger = sampledCamera(camera, perAxis);
    Image cast(larger.width, larger.height);
    castSamples(sceneOfSamples(scene), {larger, maps}, samples, cast);
    for (const std::uint32_t pixel : pixels) image.pixels[pixel] = grid.mean(cast, pixel);
}

}  // namespace tetralux::projection
