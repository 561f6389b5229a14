// SPDX-License-Identifier: Apache-2.0
#include <projection/order/exact_repair.h>

#include <algorithm>
#include <chrono>
#include <utility>

#include <projection/cells/cell_setup.h>
#include <projection/order/float_limits.h>
#include <projection/order/isosurface_ties.h>
#include <projection/reference/reference_ray_caster.h>
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
        dense_ = mode == Mode::Standard || mode == Mode::ScaleInvariant || mode == Mode::FirstHit ||
                 mode == Mode::Absorption;
        if (dense_ && engine_->name() != "reference")
            beyondFloat_ = cellsBeyondFloat(*scene.mesh, scene.transferFunction, integralOf(scene.settings.mode),
                                            mode == Mode::FirstHit, engine_->name() == "gl");
    }

    Image render(const View& view, FrameReport& report) override {
        Image image = engine_->render(view, report);
        doubtMore(view.camera, report);
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
    /// Adds the pixels of cells beyond float, those where samples beside the centres may miss outlines and, where the
    /// cell that a ray meets first shows, those where rounding would say which it is.
    void doubtMore(const Camera& camera, FrameReport& report) const {
        const CameraFrame frame = cameraFrame(camera);
        std::vector<std::uint32_t> ties, edges;
        if (dense_ && report.samplesBeside) ties = tiedPixels(scene_, frame);
        if (scene_.settings.mode == Mode::FirstHit && engine_->name() != "reference")
            edges = tiedEdgePixels(scene_, frame);
        if (ties.empty() && edges.empty() && beyondFloat_.empty()) return;
        std::vector<bool> doubtful(static_cast<std::size_t>(frame.width) * static_cast<std::size_t>(frame.height));
        for (const auto* pixels : {&report.doubtfulPixels, &ties, &edges})
            for (const std::uint32_t pixel : *pixels) doubtful[pixel] = true;
        markBeyondFloat(frame, doubtful);
        report.doubtfulPixels.clear();
        for (std::uint32_t pixel = 0; pixel < doubtful.size(); ++pixel)
            if (doubtful[pixel]) report.doubtfulPixels.push_back(pixel);
    }

    void markBeyondFloat(const CameraFrame& frame, std::vector<bool>& doubtful) const {
        if (beyondFloat_.empty()) return;
        const CellProjector projector(*scene_.mesh, sceneUnits(*scene_.mesh), frame);
        const auto width = static_cast<std::size_t>(frame.width);
        for (mesh::CellIndex cell : beyondFloat_) {
            PixelRect rect;
            if (projector.bounds(cell, rect) == SkipReason::OutsideView) continue;
            // where such a cell ends is beyond float too, and engines look at whole blocks of pixels
            const int x0 = std::max(0, rect.x0 - blockMargin), x1 = std::min(frame.width, rect.x1 + blockMargin);
            for (int y = std::max(0, rect.y0 - blockMargin); y < std::min(frame.height, rect.y1 + blockMargin); ++y)
                for (int x = x0; x < x1; ++x)
                    doubtful[static_cast<std::size_t>(y) * width + static_cast<std::size_t>(x)] = true;
        }
    }

    Scene scene_;
    bool dense_ = false;  // integrates opacity: a missed isosurface, or depth that float does not hold, shows
    std::vector<mesh::CellIndex> beyondFloat_;
    ReferenceRayCaster caster_;
};

}  // namespace

std::unique_ptr<Engine> withExactRepair(std::unique_ptr<Engine> engine, const Scene& scene) {
    return std::make_unique<RepairedEngine>(std::move(engine), scene);
}

}  // namespace tetralux::projection
