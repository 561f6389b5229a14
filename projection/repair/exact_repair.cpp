// SPDX-License-Identifier: Apache-2.0
#include <projection/repair/exact_repair.h>

#include <algorithm>
#include <chrono>
#include <optional>
#include <utility>

#include <tbb/parallel_sort.h>

#include <projection/cells/cell_setup.h>
#include <projection/core/wrapped_engine.h>
#include <projection/reference/reference_ray_caster.h>
#include <projection/repair/float_limits.h>
#include <projection/repair/isosurface_outlines.h>
#include <projection/repair/isosurface_ties.h>

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
                 mode == Mode::Absorption || scene.settings.contributions.any();
        eachCellShows_ = mode == Mode::FirstHit || scene.settings.contributions.perCell;
        if (!dense_ || engine_->name() == "reference") return;
        beyondFloat_ = cellsBeyondFloat(*scene.mesh, scene.transferFunction, integralOf(scene.settings.mode),
                                        {eachCellShows_, engine_->name() == "gl", scene.settings.shading.silhouette});
        if (!scene.transferFunction.isosurfaces.empty()) outlines_.emplace(scene);
    }

    Image render(const View& view, FrameReport& report) override {
        Image image = engine_->render(view, report);
        const auto start = std::chrono::steady_clock::now();
        doubtMore(view.camera, report);
        if (scene_.settings.order == OrderMethod::Centroid)  // asked for to see what it costs and what it spoils
            report.pixelsWrong += report.doubtfulPixels.size();
        else
            repair(view, report, image);
        const double spent =
            std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
        if (outlines_ || !report.doubtfulPixels.empty()) report.stageMilliseconds["repair"] = spent;
        report.frameMilliseconds += spent;
        return image;
    }

private:
    void repair(const View& view, FrameReport& report, Image& image) const {
        if (report.doubtfulPixels.empty()) return;
        caster_.renderPixels(view, report.doubtfulPixels, image);
        report.pixelsRepaired += report.doubtfulPixels.size();
    }

    /// Adds the pixels of cells beyond float, those where floats or samples beside the centres may miss outlines and,
    /// where single cells show, those where rounding would say which a ray meets.
    void doubtMore(const Camera& camera, FrameReport& report) const {
        const CameraFrame frame = cameraFrame(camera);
        std::vector<std::uint32_t>& pixels = report.doubtfulPixels;
        const std::size_t known = pixels.size();
        const auto add = [&](const std::vector<std::uint32_t>& more) {
            pixels.insert(pixels.end(), more.begin(), more.end());
        };
        if (dense_ && report.samplesBeside) add(tiedPixels(scene_, frame));
        if (eachCellShows_ && engine_->name() != "reference") add(tiedEdgePixels(scene_, frame));
        if (outlines_) add(outlines_->pixels(frame));
        if (!beyondFloat_.empty()) add(pixelsBeyondFloat(frame));
        if (pixels.size() == known) return;
        tbb::parallel_sort(pixels.begin(), pixels.end());
        pixels.erase(std::unique(pixels.begin(), pixels.end()), pixels.end());
    }

    /// Marked first: such cells cover the same pixels many times.
    std::vector<std::uint32_t> pixelsBeyondFloat(const CameraFrame& frame) const {
        std::vector<bool> doubtful(static_cast<std::size_t>(frame.width) * static_cast<std::size_t>(frame.height));
        markBeyondFloat(frame, doubtful);
        std::vector<std::uint32_t> pixels;
        for (std::uint32_t pixel = 0; pixel < doubtful.size(); ++pixel)
            if (doubtful[pixel]) pixels.push_back(pixel);
        return pixels;
    }

    void markBeyondFloat(const CameraFrame& frame, std::vector<bool>& doubtful) const {
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
    bool dense_ = false;          // integrates opacity: a missed isosurface, or depth that float does not hold, shows
    bool eachCellShows_ = false;  // however short a ray's way through it is
    std::vector<mesh::CellIndex> beyondFloat_;
    std::optional<IsosurfaceOutlines> outlines_;
    ReferenceRayCaster caster_;
};

}  // namespace

std::unique_ptr<Engine> withExactRepair(std::unique_ptr<Engine> engine, const Scene& scene) {
    return std::make_unique<RepairedEngine>(std::move(engine), scene);
}

}  // namespace tetralux::projection
