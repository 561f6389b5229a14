// SPDX-License-Identifier: Apache-2.0
#include <projection/frame/adaptive_opacity.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include <projection/cells/cell_setup.h>
#include <projection/core/transfer_support.h>
#include <projection/core/wrapped_engine.h>
#include <projection/frame/amount_map.h>

namespace tetralux::projection {

namespace {

double largestExtinction(const preint::TransferFunction& function) {
    double largest = 0;
    for (const auto& node : function.extinction) largest = std::max(largest, node.extinction);
    return largest;
}

double largestPeakDepth(const preint::TransferFunction& function) {
    double largest = 0;
    for (const auto& surface : function.isosurfaces)
        largest = std::max(largest, -std::log1p(-std::min(surface.opacity, 1.0 - 1e-9)));
    return largest;
}

/// What one cell is of the integral's path: the edge of a cube of its mean volume, or its mean range of the scalar.
double cellSize(const mesh::ScalarMesh& mesh, preint::Integral integral) {
    double sum = 0;
    std::size_t count = 0;
    for (mesh::CellIndex cell = 0; cell < mesh.cells.size(); ++cell) {
        double part = 0;
        if (integral == preint::Integral::Standard) {
            std::array<glm::dvec3, 4> p;
            for (std::size_t k = 0; k < 4; ++k) p[k] = mesh.positions[mesh.cells[cell][k]];
            part = std::abs(mesh::sixVolumes(p[0], p[1], p[2], p[3])) / 6.0;
        } else {
            const glm::dvec2 scalars = scalarRange(mesh, cell);
            part = scalars.y - scalars.x;
        }
        sum += part;
        count += part > 0 ? 1 : 0;
    }
    const double mean = count > 0 ? sum / static_cast<double>(count) : 0.0;
    return integral == preint::Integral::Standard ? std::cbrt(mean) : mean;
}

bool countsCells(const Scene& scene) {
    return scene.settings.adaptive->amount == AdaptiveSettings::Amount::Cells ||
           !(largestExtinction(scene.transferFunction) > 0);
}

Scene measuringScene(const Scene& scene) {
    const SceneUnits units = sceneUnits(*scene.mesh);
    const bool overData = integralOf(scene.settings.mode) == preint::Integral::ScaleInvariant;
    Scene measuring = scene;
    measuring.settings.adaptive.reset();
    measuring.settings.shading = {};
    measuring.settings.classification = Classification::Preintegrated;
    measuring.settings.mode = overData ? Mode::DataContribution : Mode::Contribution;
    measuring.transferFunction = relevanceOf(scene.transferFunction, scene.settings.adaptive->threshold,
                                             1.0 / (overData ? units.scalarScale : units.length));
    measuring.mapSources.clear();
    return measuring;
}

Scene drawnScene(const Scene& scene) {
    const AdaptiveScale scale = adaptiveScale(scene);
    Scene drawn = scene;
    drawn.settings.adaptive.reset();
    drawn.settings.largestExtinctionScale = scale.most * scale.perTau;
    drawn.mapSources.clear();
    return drawn;
}

class AdaptiveEngine final : public WrappedEngine {
public:
    AdaptiveEngine(const Scene& scene, const MakeEngine& make)
        : WrappedEngine(make(drawnScene(scene))),
          settings_(*scene.settings.adaptive),
          countsCells_(countsCells(scene)),
          scale_(adaptiveScale(scene)),
          measuring_(make(measuringScene(scene))) {}

    Image render(const View& view, FrameReport& report) override {
        const auto start = std::chrono::steady_clock::now();
        FrameReport measured;
        const std::vector<float> amounts = amountMap(view, settings_, countsCells_ ? 0 : 1, [&](const View& small) {
            return measuring_->render(small, measured);
        });
        auto maps = view.maps != nullptr ? std::make_shared<PixelMaps>(*view.maps) : std::make_shared<PixelMaps>();
        const bool given = !maps->extinctionScale.empty();
        maps->extinctionScale.resize(amounts.size(), 1.0f);
        for (std::size_t i = 0; i < amounts.size(); ++i) {
            const double factor = scale_.factorOf(static_cast<double>(amounts[i]));
            maps->extinctionScale[i] =
                static_cast<float>(given ? factor * static_cast<double>(maps->extinctionScale[i]) : factor);
        }
        report.maps = maps;
        const double spent =
            std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
        Image image = engine_->render({view.camera, maps.get(), view.control}, report);
        report.stageMilliseconds["measure"] += spent;
        report.frameMilliseconds += spent;
        return image;
    }

private:
    AdaptiveSettings settings_;
    bool countsCells_;
    AdaptiveScale scale_;
    std::unique_ptr<Engine> measuring_;  ///< what draws is the wrapped one
};

}  // namespace

double AdaptiveScale::factorOf(double amount) const {
    return perTau * (amount * most > gain ? gain / amount : most);
}

AdaptiveScale adaptiveScale(const Scene& scene) {
    const AdaptiveSettings& settings = *scene.settings.adaptive;
    const auto integral = integralOf(scene.settings.mode);
    const SceneUnits units = sceneUnits(*scene.mesh);
    const double strongest = largestExtinction(scene.transferFunction);
    AdaptiveScale scale{settings.gain, settings.most, 0.0};
    if (!(strongest > 0)) {
        const double depth = largestPeakDepth(scene.transferFunction);
        scale.perTau = depth > 0 ? 1.0 / depth : 0.0;
        return scale;
    }
    const double unit = settings.amount == AdaptiveSettings::Amount::Cells ? cellSize(*scene.mesh, integral)
                        : integral == preint::Integral::Standard           ? units.length
                                                                           : units.scalarScale;
    scale.perTau = unit > 0 ? 1.0 / (strongest * unit) : 0.0;
    return scale;
}

preint::TransferFunction relevanceOf(const preint::TransferFunction& function, double threshold, double perUnit) {
    preint::TransferFunction result;
    result.color = {{0.0, glm::dvec3(1)}};
    result.isosurfaces = function.isosurfaces;
    const double limit = threshold * largestExtinction(function);
    const auto relevant = [&](double extinction) { return extinction > 0 && extinction >= limit; };
    const auto& nodes = function.extinction;
    auto& steps = result.extinction;
    const auto append = [&](double scalar, bool on) {
        const double value = on ? perUnit : 0.0;
        if (!steps.empty() && steps.back().extinction == value) return;
        if (!steps.empty()) steps.push_back({scalar, steps.back().extinction});
        steps.push_back({scalar, value});
    };
    if (nodes.empty()) {
        steps = {{0.0, 0.0}};
        return result;
    }
    append(nodes.front().scalar, relevant(nodes.front().extinction));
    for (std::size_t i = 0; i + 1 < nodes.size(); ++i) {
        const auto &a = nodes[i], &b = nodes[i + 1];
        if (a.scalar == b.scalar) continue;
        const bool atA = relevant(a.extinction), atB = relevant(b.extinction);
        const double crossing =
            atA == atB ? a.scalar
                       : a.scalar + std::clamp((limit - a.extinction) / (b.extinction - a.extinction), 0.0, 1.0) *
                                        (b.scalar - a.scalar);
        append(a.scalar, atA);
        if (atA != atB) append(crossing, atB);
    }
    append(nodes.back().scalar, relevant(nodes.back().extinction));
    return result;
}

std::unique_ptr<Engine> makeAdaptiveEngine(const Scene& scene, const MakeEngine& make) {
    return std::make_unique<AdaptiveEngine>(scene, make);
}

}  // namespace tetralux::projection
