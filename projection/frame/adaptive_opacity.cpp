// SPDX-License-Identifier: Apache-2.0
#include <projection/frame/adaptive_opacity.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include <tbb/parallel_sort.h>
#include <glm/geometric.hpp>

#include <projection/core/scene_units.h>
#include <projection/core/wrapped_engine.h>
#include <projection/frame/contribution_map.h>
#include <projection/reference/reference_ray_caster.h>

namespace tetralux::projection {

namespace {

using Unit = AdaptiveSettings::Unit;

double largestExtinction(const preint::TransferFunction& function) {
    double largest = 0;
    for (const auto& node : function.extinction) largest = std::max(largest, node.extinction);
    return largest;
}

AdaptiveSettings settingsOf(const Scene& scene) {
    return scene.settings.adaptive.value_or(AdaptiveSettings{});
}

/// The scene in which `mode`, or over cells that of the standard integral, draws δ: in cells the extinction is 1 per
/// scene unit, and any number would do.
Scene relevanceScene(const Scene& scene, Mode mode, double isosurfaceOpacity) {
    const AdaptiveSettings settings = settingsOf(scene);
    if (settings.unit == Unit::Cells && mode == Mode::ScaleInvariant) mode = Mode::Standard;
    if (settings.unit == Unit::Cells && mode == Mode::DataAdditive) mode = Mode::Additive;
    const preint::Integral integral = integralOf(mode);
    const SceneUnits units = sceneUnits(*scene.mesh);
    double piece = integral == preint::Integral::Standard ? units.length : units.scalarScale;
    if (settings.unit == Unit::Length)
        piece = settings.pieceLength > 0 ? settings.pieceLength : meanEdge(*scene.mesh, integral);
    Scene result = scene;
    result.settings.adaptive.reset();
    result.settings.mode = mode;
    result.settings.contributions.perCell = settings.unit == Unit::Cells;
    result.transferFunction =
        relevanceOf(scene.transferFunction, settings.threshold, piece > 0 ? 1.0 / piece : 0.0, isosurfaceOpacity);
    result.mapSources.clear();
    return result;
}

/// Draws Σ c and, as alpha, N, of a scene with the shading of the picture or without.
Scene sumsScene(const Scene& scene, bool shaded) {
    const bool overData = integralOf(scene.settings.mode) == preint::Integral::ScaleInvariant;
    Scene sums = relevanceScene(scene, overData ? Mode::DataAdditive : Mode::Additive, 1.0);
    sums.settings.contributions.sums = true;
    if (!shaded) sums.settings.shading = {};
    return sums;
}

/// Draws the picture once the pixels' factors are known.
Scene hidingScene(const Scene& scene) {
    Scene hiding = relevanceScene(scene, scene.settings.mode, -std::expm1(-1.0));
    hiding.settings.largestExtinctionScale = contributionDepth(0.0, settingsOf(scene).most);
    return hiding;
}

/// What is drawn of sums: their mean, or their number.
void finishSums(Mode mode, glm::vec4& pixel) {
    const float count = pixel.a;
    if (!(count > 0.0f))
        pixel = glm::vec4(0);
    else if (mode == Mode::Contributions)
        pixel = glm::vec4(count, count, count, 1.0f);
    else
        pixel = glm::vec4(glm::vec3(pixel) / count, mode == Mode::Emission ? 0.0f : 1.0f);
}

double millisecondsSince(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

/// Modes that add up, and the map itself where it is not smoothed: one pass.
class MeanEngine final : public WrappedEngine {
public:
    MeanEngine(const Scene& scene, const MakeEngine& make)
        : WrappedEngine(make(sumsScene(scene, true))), mode_(scene.settings.mode) {}

    Image render(const View& view, FrameReport& report) override {
        Image image = engine_->render(view, report);
        for (glm::vec4& pixel : image.pixels) finishSums(mode_, pixel);
        return image;
    }

private:
    Mode mode_;
};

/// The map of contributions.
class CountingEngine final : public WrappedEngine {
public:
    CountingEngine(const Scene& scene, const MakeEngine& make)
        : WrappedEngine(make(sumsScene(scene, false))), settings_(settingsOf(scene)) {}

    Image render(const View& view, FrameReport& report) override {
        const std::vector<float> counts =
            contributionMap(view, settings_, [&](const View& small) { return engine_->render(small, report); });
        Image image(view.camera.width, view.camera.height);
        for (std::size_t i = 0; i < counts.size(); ++i) {
            image.pixels[i].a = counts[i];
            finishSums(Mode::Contributions, image.pixels[i]);
        }
        return image;
    }

private:
    AdaptiveSettings settings_;
};

/// Modes that hide: two passes.
class AdaptiveEngine final : public WrappedEngine {
public:
    AdaptiveEngine(const Scene& scene, const MakeEngine& make)
        : WrappedEngine(make(hidingScene(scene))),
          settings_(settingsOf(scene)),
          counting_(make(sumsScene(scene, false))) {}

    Image render(const View& view, FrameReport& report) override {
        const auto start = std::chrono::steady_clock::now();
        FrameReport counted;
        const std::vector<float> counts =
            contributionMap(view, settings_, [&](const View& small) { return counting_->render(small, counted); });
        auto maps = view.maps != nullptr ? std::make_shared<PixelMaps>(*view.maps) : std::make_shared<PixelMaps>();
        maps->extinctionScale.resize(counts.size());
        for (std::size_t i = 0; i < counts.size(); ++i)
            maps->extinctionScale[i] =
                static_cast<float>(contributionDepth(static_cast<double>(counts[i]), settings_.most));
        report.maps = maps;
        const double spent = millisecondsSince(start);
        Image image = engine_->render({view.camera, maps.get(), view.control}, report);
        report.stageMilliseconds["count"] += spent;
        report.frameMilliseconds += spent;
        return image;
    }

private:
    AdaptiveSettings settings_;
    std::unique_ptr<Engine> counting_;  ///< what draws is the wrapped one
};

}  // namespace

bool isAdaptive(const RenderSettings& settings) {
    return settings.adaptive.has_value() || settings.mode == Mode::Contributions;
}

double contributionDepth(double count, double most) {
    constexpr double opaque = 64.0, least = 0.01;  // exp(−64) is 0 beside 1, also of as little as that
    const double opacity = count * most > 1.0 ? 1.0 / count : most;
    const double bound = opaque / std::clamp(count, least, 1.0);
    return opacity < 1.0 ? std::min(-std::log1p(-opacity), bound) : bound;
}

preint::TransferFunction relevanceOf(const preint::TransferFunction& function, double threshold, double level,
                                     double isosurfaceOpacity) {
    constexpr double leastStep = 1e-30;  // of a ramp's width: one over what lies between is still a number
    preint::TransferFunction result;
    result.color = function.color;
    for (const preint::Isosurface& surface : function.isosurfaces)
        if (surface.opacity > 0) result.isosurfaces.push_back({surface.value, isosurfaceOpacity, surface.color});
    const double limit = threshold * largestExtinction(function);
    const auto& nodes = function.extinction;
    auto& steps = result.extinction;
    const auto append = [&](double scalar, bool on) {
        const double value = on ? level : 0.0;
        if (!steps.empty() && steps.back().extinction == value) return;
        if (!steps.empty() && steps.back().scalar != scalar) steps.push_back({scalar, steps.back().extinction});
        steps.push_back({scalar, value});
    };
    if (nodes.empty()) {
        steps = {{0.0, 0.0}};
        return result;
    }
    append(nodes.front().scalar, nodes.front().extinction > limit);
    for (std::size_t i = 0; i + 1 < nodes.size(); ++i) {
        const auto &a = nodes[i], &b = nodes[i + 1];
        if (a.scalar == b.scalar) continue;
        if (a.extinction > limit) {
            append(a.scalar, true);
            if (b.extinction > limit) continue;
            append(a.scalar + (a.extinction - limit) / (a.extinction - b.extinction) * (b.scalar - a.scalar), false);
        } else if (b.extinction > limit) {
            const double foot =
                a.scalar + (limit - a.extinction) / (b.extinction - a.extinction) * (b.scalar - a.scalar);
            append(a.scalar, false);
            append(std::max(std::nextafter(foot, b.scalar), foot + leastStep * (b.scalar - foot)), true);
        } else {
            append(a.scalar, false);
        }
    }
    append(nodes.back().scalar, nodes.back().extinction > limit);
    return result;
}

double meanEdge(const mesh::ScalarMesh& mesh, preint::Integral integral) {
    constexpr std::pair<std::size_t, std::size_t> cornersOf[] = {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}};
    const bool overData = integral == preint::Integral::ScaleInvariant;
    double sum = 0;
    std::size_t count = 0;
    const auto add = [&](double length) {
        sum += length;
        count += length > 0 ? 1 : 0;
    };
    if (overData && mesh.association == mesh::Association::Cell) return 0.0;  // constant wherever rays go
    std::vector<std::uint64_t> edges;
    edges.reserve(6 * mesh.cells.size());
    for (const mesh::Tetrahedron& cell : mesh.cells)
        for (const auto& [i, j] : cornersOf) {
            const auto [low, high] = std::minmax(cell[i], cell[j]);
            edges.push_back(std::uint64_t{low} << 32 | high);
        }
    tbb::parallel_sort(edges.begin(), edges.end());
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    for (const std::uint64_t edge : edges) {
        const auto a = static_cast<mesh::PointIndex>(edge >> 32), b = static_cast<mesh::PointIndex>(edge & 0xffffffffu);
        add(overData ? std::abs(mesh.scalars[a] - mesh.scalars[b])
                     : glm::distance(mesh.positions[a], mesh.positions[b]));
    }
    return count > 0 ? sum / static_cast<double>(count) : 0.0;
}

std::unique_ptr<Engine> makeAdaptiveEngine(const Scene& scene, const MakeEngine& make) {
    if (scene.settings.mode == Mode::Contributions) return std::make_unique<CountingEngine>(scene, make);
    if (addsUp(scene.settings.mode)) return std::make_unique<MeanEngine>(scene, make);
    return std::make_unique<AdaptiveEngine>(scene, make);
}

void castAdaptivePixels(const Scene& scene, const View& view, const std::vector<std::uint32_t>& pixels, Image& image) {
    const AdaptiveSettings settings = settingsOf(scene);
    const Mode mode = scene.settings.mode;
    if (addsUp(mode)) {
        ReferenceRayCaster(sumsScene(scene, true)).renderPixels(view, pixels, image);
        for (const std::uint32_t pixel : pixels) finishSums(mode, image.pixels[pixel]);
        return;
    }
    // a smoothed count is that of its neighbours too
    const ReferenceRayCaster counting(sumsScene(scene, false));
    const std::vector<float> counts = contributionMap(view, settings, [&](const View& small) {
        Image counted(small.camera.width, small.camera.height);
        RayCastCounts ignored;
        if (settings.filter == AdaptiveSettings::Filter::None)
            counting.renderPixels(small, pixels, counted);
        else
            counted = counting.render(small, ignored);
        return counted;
    });
    if (mode == Mode::Contributions) {
        for (const std::uint32_t pixel : pixels) {
            image.pixels[pixel].a = counts[pixel];
            finishSums(mode, image.pixels[pixel]);
        }
        return;
    }
    PixelMaps maps = view.maps != nullptr ? *view.maps : PixelMaps();
    maps.extinctionScale.assign(counts.size(), 1.0f);
    for (const std::uint32_t pixel : pixels)
        maps.extinctionScale[pixel] =
            static_cast<float>(contributionDepth(static_cast<double>(counts[pixel]), settings.most));
    ReferenceRayCaster(hidingScene(scene)).renderPixels({view.camera, &maps}, pixels, image);
}

}  // namespace tetralux::projection
