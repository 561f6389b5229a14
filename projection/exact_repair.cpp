// SPDX-License-Identifier: Apache-2.0
#include <projection/exact_repair.h>

#include <algorithm>
#include <chrono>
#include <utility>

#include <projection/cell_setup.h>
#include <projection/float_limits.h>
#include <projection/reference_ray_caster.h>
#include <projection/wrapped_engine.h>

namespace tetralux::projection {

namespace {

/// Pixels beside a cell's rectangle in which float planes of a flat cell may be evaluated.
constexpr int blockMargin = 16;

class RepairedEngine final : public WrappedEngine {
public:
    RepairedEngine(std::unique_ptr<Engine> engine, const Scene& scene)
        : WrappedEngine(std::move(engine)), scene_(scene), caster_(scene) {
        const Mode mode = scene.settings.mode;
        const bool dense = mode == Mode::Standard || mode == Mode::ScaleInvariant || mode == Mode::FirstHit ||
                           mode == Mode::Absorption;
        if (dense && engine_->name() != "reference")
            beyondFloat_ = cellsBeyondFloat(*scene.mesh, scene.transferFunction, integralOf(scene.settings.mode));
    }

    Image render(const View& view, FrameReport& report) override {
        Image image = engine_->render(view, report);
        if (!beyondFloat_.empty()) doubtCellsBeyondFloat(view.camera, report);
        if (scene_.settings.order == OrderMethod::Centroid) {  // asked for to see what it costs and what it spoils
            report.pixelsWrong += report.doubtfulPixels.size();
            return image;
        }
        if (report.doubtfulPixels.empty()) return image;
        const auto start = std::chrono::steady_clock::now();
        caster_.renderPixels(view, report.doubtfulPixels, image);
        const double spent =
            std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
        report.stageMilliseconds["repair"] = spent;
        report.frameMilliseconds += spent;
        report.pixelsRepaired += report.doubtfulPixels.size();
        return image;
    }

private:
    void doubtCellsBeyondFloat(const Camera& camera, FrameReport& report) const {
        const CellProjector projector(*scene_.mesh, sceneUnits(*scene_.mesh), cameraFrame(camera));
        const auto width = static_cast<std::uint32_t>(camera.width);
        std::vector<bool> doubtful(static_cast<std::size_t>(camera.width) * static_cast<std::size_t>(camera.height));
        for (std::uint32_t pixel : report.doubtfulPixels) doubtful[pixel] = true;
        for (mesh::CellIndex cell : beyondFloat_) {
            PixelRect rect;
            if (projector.bounds(cell, rect) == SkipReason::OutsideView) continue;
            // where such a cell ends is beyond float too, and engines look at whole blocks of pixels
            for (int y = std::max(0, rect.y0 - blockMargin); y < std::min(camera.height, rect.y1 + blockMargin); ++y)
                for (int x = std::max(0, rect.x0 - blockMargin); x < std::min(camera.width, rect.x1 + blockMargin); ++x)
                    doubtful[static_cast<std::uint32_t>(y) * width + static_cast<std::uint32_t>(x)] = true;
        }
        report.doubtfulPixels.clear();
        for (std::uint32_t pixel = 0; pixel < doubtful.size(); ++pixel)
            if (doubtful[pixel]) report.doubtfulPixels.push_back(pixel);
    }

    Scene scene_;
    std::vector<mesh::CellIndex> beyondFloat_;
    ReferenceRayCaster caster_;
};

}  // namespace

std::unique_ptr<Engine> withExactRepair(std::unique_ptr<Engine> engine, const Scene& scene) {
    return std::make_unique<RepairedEngine>(std::move(engine), scene);
}

}  // namespace tetralux::projection
