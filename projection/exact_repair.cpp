// SPDX-License-Identifier: Apache-2.0
#include <projection/exact_repair.h>

#include <chrono>
#include <utility>

#include <projection/reference_ray_caster.h>

namespace tetralux::projection {

namespace {

class RepairedEngine final : public Engine {
public:
    RepairedEngine(std::unique_ptr<Engine> engine, const Scene& scene)
        : engine_(std::move(engine)), caster_(scene) {}

    Image render(const Camera& camera, FrameReport& report) override {
        Image image = engine_->render(camera, report);
        if (report.doubtfulPixels.empty()) return image;
        const auto start = std::chrono::steady_clock::now();
        caster_.renderPixels(camera, report.doubtfulPixels, image);
        const double spent =
            std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
        report.stageMilliseconds["repair"] = spent;
        report.frameMilliseconds += spent;
        report.pixelsRepaired += report.doubtfulPixels.size();
        return image;
    }

    std::string name() const override { return engine_->name(); }
    std::string renderer() const override { return engine_->renderer(); }
    std::map<std::string, double> prepareMilliseconds() const override { return engine_->prepareMilliseconds(); }
    const preint::PreintegrationTable* table() const override { return engine_->table(); }

private:
    std::unique_ptr<Engine> engine_;
    ReferenceRayCaster caster_;
};

}  // namespace

std::unique_ptr<Engine> withExactRepair(std::unique_ptr<Engine> engine, const Scene& scene) {
    return std::make_unique<RepairedEngine>(std::move(engine), scene);
}

}  // namespace tetralux::projection
