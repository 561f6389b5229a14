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
#include <projection/repair/edge_on_faces.h>
#include <projection/repair/eye_contact.h>
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
        : WrappedEngine(std::move(engine)), scene_(scene), gathers_(gathersOf(scene.settings.mode)), caster_(scene) {
        exact_ = engine_->name() == "reference";
        if (exact_) return;
        beyondFloat_ = cellsBeyondFloat(*scene.mesh, scene.transferFunction, integralOf(scene.settings.mode),
                                        floatUse(scene.settings, engine_->name() == "gl"));
        if (gathers_ != FloatUse::Gathers::Light && gathers_ != FloatUse::Gathers::Crossings) return;
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
        mendWhatIsNotFinite(view, report, image);
        const double spent =
            std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
        if (outlines_ || !report.doubtfulPixels.empty()) report.stageMilliseconds["repair"] = spent;
        report.frameMilliseconds += spent;
        return image;
    }

private:
    static FloatUse floatUse(const RenderSettings& settings, bool fromTable) {
        const Mode mode = settings.mode;
        return {.scalarsShow = mode == Mode::FirstHit || settings.contributions.perCell,
                .fromTable = fromTable,
                .silhouettes = settings.shading.silhouette,
                .addsUp = addsUp(mode),
                .gathers = gathersOf(mode)};
    }

    static FloatUse::Gathers gathersOf(Mode mode) {
        switch (mode) {
            case Mode::Mip:
            case Mode::Minimum:
                return FloatUse::Gathers::Extreme;
            case Mode::Average:
                return FloatUse::Gathers::Mean;
            case Mode::Depth:
                return FloatUse::Gathers::Crossings;
            default:
                return FloatUse::Gathers::Light;
        }
    }

    /// Whether anything counts for something, however little of it a ray meets.
    bool touchingShows() const {
        return gathers_ != FloatUse::Gathers::Light || scene_.settings.mode == Mode::FirstHit ||
               scene_.settings.contributions.perCell;
    }

    /// No picture holds a value that is not finite: what float made of a pixel is composed again in double, and what is
    /// beyond float even so is no picture.
    void mendWhatIsNotFinite(const View& view, FrameReport& report, Image& image) const {
        std::vector<std::uint32_t> pixels = pixelsNotFinite(image);
        if (pixels.empty()) return;
        if (!exact_) {
            caster_.renderPixels(view, pixels, image);
            report.pixelsRepaired += pixels.size();
            pixels = pixelsNotFinite(image);
        }
        if (!pixels.empty()) requireFinite(image, "picture");
    }

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
        if (exact_) return;
        if (report.samplesBeside) add(tiedPixels(scene_, frame));
        if (touchingShows()) {
            add(tiedEdgePixels(scene_, frame));
            if (!frame.orthographic) addEyeContact(frame, pixels);
        }
        add(edgeOnPixels(*scene_.mesh, frame,
                         report.cellsEdgeOn ? *report.cellsEdgeOn : cellsSeenEdgeOn(*scene_.mesh, frame),
                         report.samplesBeside));
        if (outlines_) add(outlines_->pixels(frame));
        if (!beyondFloat_.empty()) add(pixelsOf(beyondFloat_, blockMargin, frame));
        if (pixels.size() == known) return;
        tbb::parallel_sort(pixels.begin(), pixels.end());
        pixels.erase(std::unique(pixels.begin(), pixels.end()), pixels.end());
    }

    /// Cells that end or begin right where rays do. In the first hit any of them may be taken for what is hit; elsewhere
    /// only those count before which there may be nothing.
    void addEyeContact(const CameraFrame& frame, std::vector<std::uint32_t>& pixels) const {
        const EyeContact contact = eyeContact(*scene_.mesh, frame.eye);
        if (contact.cells.empty() || !(contact.onBoundary || scene_.settings.mode == Mode::FirstHit ||
                                         scene_.settings.contributions.perCell)) return;
        const std::vector<std::uint32_t> more = pixelsOf(contact.cells, 0, frame);
        pixels.insert(pixels.end(), more.begin(), more.end());
    }

    /// The pixels of cells. Marked first: such cells cover the same pixels many times.
    std::vector<std::uint32_t> pixelsOf(const std::vector<mesh::CellIndex>& cells, int margin,
                                        const CameraFrame& frame) const {
        std::vector<bool> doubtful(static_cast<std::size_t>(frame.width) * static_cast<std::size_t>(frame.height));
        mark(cells, margin, frame, doubtful);
        std::vector<std::uint32_t> pixels;
        for (std::uint32_t pixel = 0; pixel < doubtful.size(); ++pixel)
            if (doubtful[pixel]) pixels.push_back(pixel);
        return pixels;
    }

    /// Where a cell beyond float ends is beyond float too, and engines look at whole blocks of pixels: hence a margin.
    void mark(const std::vector<mesh::CellIndex>& cells, int margin, const CameraFrame& frame,
              std::vector<bool>& doubtful) const {
        const CellProjector projector(*scene_.mesh, sceneUnits(*scene_.mesh), frame);
        const auto width = static_cast<std::size_t>(frame.width);
        for (mesh::CellIndex cell : cells) {
            PixelRect rect;
            if (projector.bounds(cell, rect) == SkipReason::OutsideView) continue;
            const int x0 = std::max(0, rect.x0 - margin), x1 = std::min(frame.width, rect.x1 + margin);
            for (int y = std::max(0, rect.y0 - margin); y < std::min(frame.height, rect.y1 + margin); ++y)
                for (int x = x0; x < x1; ++x)
                    doubtful[static_cast<std::size_t>(y) * width + static_cast<std::size_t>(x)] = true;
        }
    }

    Scene scene_;
    const FloatUse::Gathers gathers_;
    bool exact_ = false;  // the engine is the reference
    std::vector<mesh::CellIndex> beyondFloat_;
    std::optional<IsosurfaceOutlines> outlines_;
    ReferenceRayCaster caster_;
};

}  // namespace

std::unique_ptr<Engine> withExactRepair(std::unique_ptr<Engine> engine, const Scene& scene) {
    return std::make_unique<RepairedEngine>(std::move(engine), scene);
}

}  // namespace tetralux::projection
