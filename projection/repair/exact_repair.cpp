// SPDX-License-Identifier: Apache-2.0
#include <projection/repair/exact_repair.h>

#include <algorithm>
#include <chrono>
#include <optional>
#include <utility>

#include <projection/cells/cell_setup.h>
#include <projection/core/wrapped_engine.h>
#include <projection/reference/reference_ray_caster.h>
#include <projection/repair/edge_on_faces.h>
#include <projection/repair/eye_contact.h>
#include <projection/repair/float_limits.h>
#include <projection/repair/isosurface_outlines.h>
#include <projection/repair/isosurface_perturbation.h>
#include <projection/repair/uncertain_pixels.h>

namespace tetralux::projection {

namespace {

/// Pixels beside a cell's rectangle in which engines may evaluate its planes in float.
constexpr int blockMargin = 16;

class RepairedEngine final : public WrappedEngine {
public:
    RepairedEngine(std::unique_ptr<Engine> engine, const Scene& scene, const EngineTraits& traits)
        : WrappedEngine(std::move(engine)),
          scene_(scene),
          gathers_(gathersOf(scene.settings.mode)),
          exact_(traits.exact),
          edgeOnFaces_(scene),
          caster_(scene) {
        if (exact_) return;
        beyondFloat_ = cellsBeyondFloat(*scene.mesh, scene.transferFunction, integralOf(scene.settings.mode),
                                        floatUse(scene.settings, traits.fromTable));
        if (gathers_ != FloatUse::Gathers::Light && gathers_ != FloatUse::Gathers::Crossings) return;
        if (!scene.transferFunction.isosurfaces.empty()) outlines_.emplace(scene);
    }

    Image render(const View& view, FrameReport& report) override {
        Image image = engine_->render(view, report);
        if (exact_) {
            requireFinite(image, "picture");
            return image;
        }
        const auto start = std::chrono::steady_clock::now();
        const UncertainPixels uncertain = uncertainPixels(view.camera, image, report);
        if (scene_.settings.order == OrderMethod::Centroid)  // asked for to see what it costs and what it spoils
            report.pixelsWrong += repairWithoutOrder(view, uncertain, image, report);
        else
            repair(view, uncertain, image, report);
        requireFinite(image, "picture");  // what is beyond float in double too is no picture
        const double spent =
            std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
        if (outlines_ || uncertain.any()) report.stageMilliseconds["repair"] = spent;
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

    void repair(const View& view, const UncertainPixels& uncertain, Image& image, FrameReport& report) const {
        if (!uncertain.any()) return;
        const std::vector<std::uint32_t> pixels = uncertain.ascending();
        caster_.renderPixels(view, pixels, image);
        report.pixelsRepaired += pixels.size();
        for (const auto& [reason, count] : uncertain.byReason()) report.repairedBecause[reason] += count;
    }

    /// Mends only what is no number; how many other pixels are uncertain.
    std::uint64_t repairWithoutOrder(const View& view, const UncertainPixels& uncertain, Image& image,
                                     FrameReport& report) const {
        UncertainPixels unvouched(image.pixels.size());
        unvouched.add(Uncertainty::NotANumber, pixelsNotFinite(image));
        repair(view, unvouched, image, report);
        return uncertain.ascending().size() - unvouched.ascending().size();
    }

    /// Those that the engine names or that are no number, as it makes what it cannot vouch for; those of cells beyond
    /// float; those where floats or samples beside the centres may miss outlines and, where single cells show, those
    /// where rounding would say which a ray meets.
    UncertainPixels uncertainPixels(const Camera& camera, const Image& image, const FrameReport& report) const {
        CameraFrame frame = cameraFrame(camera);
        UncertainPixels pixels(image.pixels.size());
        pixels.add(Uncertainty::Order, report.uncertainPixels);
        pixels.add(Uncertainty::NotANumber, pixelsNotFinite(image));
        if (touchingShows()) {
            pixels.add(Uncertainty::EdgeMet, perturbedEdgePixels(scene_, frame));
            if (!frame.orthographic) addEyeContact(frame, pixels);
        }
        if (outlines_) pixels.add(Uncertainty::Outline, outlines_->pixels(frame));
        if (!beyondFloat_.empty()) addPixelsOf(beyondFloat_, Uncertainty::BeyondFloat, frame, pixels);
        if (!report.floatSamples) return pixels;
        frame.sampleShift = *report.floatSamples;
        if (outlines_) pixels.add(Uncertainty::Outline, perturbedPixels(scene_, frame));
        pixels.add(Uncertainty::FaceEdgeOn, edgeOnFaces_.pixels(frame, edgeOnFaces_.candidates(frame)));
        return pixels;
    }

    /// Cells that end or begin right where rays do. In the first hit any of them may be taken for what is hit;
    /// elsewhere only those count before which there may be nothing.
    void addEyeContact(const CameraFrame& frame, UncertainPixels& pixels) const {
        const EyeContact contact = eyeContact(*scene_.mesh, frame.eye);
        if (contact.cells.empty() ||
            !(contact.onBoundary || scene_.settings.mode == Mode::FirstHit || scene_.settings.contributions.perCell))
            return;
        addPixelsOf(contact.cells, Uncertainty::EyeTouched, frame, pixels);
    }

    /// Where such cells end is for rounding to say too, and engines look at whole blocks of pixels: hence a margin.
    void addPixelsOf(const std::vector<mesh::CellIndex>& cells, Uncertainty reason, const CameraFrame& frame,
                     UncertainPixels& pixels) const {
        const CellProjector projector(*scene_.mesh, sceneUnits(*scene_.mesh), frame);
        for (mesh::CellIndex cell : cells) {
            PixelRect rect;
            if (projector.bounds(cell, rect) == SkipReason::OutsideView) continue;
            const int x0 = std::max(0, rect.x0 - blockMargin), x1 = std::min(frame.width, rect.x1 + blockMargin);
            for (int y = std::max(0, rect.y0 - blockMargin); y < std::min(frame.height, rect.y1 + blockMargin); ++y)
                for (int x = x0; x < x1; ++x)
                    pixels.mark(reason, static_cast<std::uint32_t>(y) * static_cast<std::uint32_t>(frame.width) +
                                            static_cast<std::uint32_t>(x));
        }
    }

    Scene scene_;
    const FloatUse::Gathers gathers_;
    const bool exact_;
    std::vector<mesh::CellIndex> beyondFloat_;
    std::optional<IsosurfaceOutlines> outlines_;
    const EdgeOnFaces edgeOnFaces_;
    ReferenceRayCaster caster_;
};

}  // namespace

std::unique_ptr<Engine> withExactRepair(std::unique_ptr<Engine> engine, const Scene& scene,
                                        const EngineTraits& traits) {
    return std::make_unique<RepairedEngine>(std::move(engine), scene, traits);
}

}  // namespace tetralux::projection
