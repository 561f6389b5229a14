// SPDX-License-Identifier: Apache-2.0
#include <projection/reference/reference_engine.h>

#include <chrono>

#include <projection/reference/reference_ray_caster.h>

namespace tetralux::projection {

namespace {

class ReferenceEngine final : public Engine {
public:
    explicit ReferenceEngine(const Scene& scene) : cellCount_(scene.mesh->cells.size()), caster_(scene) {}

    Image render(const View& view, FrameReport& report) override {
        const auto start = std::chrono::steady_clock::now();
        RayCastCounts counts;
        Image image = caster_.render(view, counts);
        report.frameMilliseconds =
            std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
        report.stageMilliseconds["cast"] = report.frameMilliseconds;
        report.cellsDrawn = counts.cellsDrawn;
        if (cellCount_ > counts.cellsDrawn) report.cellsSkipped["met by no ray"] = cellCount_ - counts.cellsDrawn;
        report.fragments = counts.segments;
        report.orderMethod = "per ray";
        return image;
    }

    std::string name() const override { return "reference"; }
    std::string renderer() const override { return "double precision, per ray"; }

private:
    std::uint64_t cellCount_;
    ReferenceRayCaster caster_;
};

}  // namespace

std::unique_ptr<Engine> makeReferenceEngine(const Scene& scene, const EngineOptions&) {
    return std::make_unique<ReferenceEngine>(scene);
}

}  // namespace tetralux::projection
