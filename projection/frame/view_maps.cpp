// SPDX-License-Identifier: Apache-2.0
#include <projection/frame/view_maps.h>

#include <chrono>
#include <utility>

#include <projection/core/wrapped_engine.h>

namespace tetralux::projection {

namespace {

class MappedEngine final : public WrappedEngine {
public:
    MappedEngine(std::unique_ptr<Engine> engine, const Scene& scene)
        : WrappedEngine(std::move(engine)), sources_(scene.mapSources) {}

    Image render(const View& view, FrameReport& report) override {
        const auto start = std::chrono::steady_clock::now();
        auto maps = view.maps != nullptr ? std::make_shared<PixelMaps>(*view.maps) : std::make_shared<PixelMaps>();
        for (const auto& source : sources_) source->apply(view.camera, *maps);
        const double spent =
            std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
        Image image = engine_->render({view.camera, maps->changeVolume() ? maps.get() : nullptr, view.control}, report);
        composeBehind(image, *maps);
        if (!report.maps) report.maps = maps;  // adaptive opacity adds to them
        report.stageMilliseconds["maps"] += spent;
        report.frameMilliseconds += spent;
        return image;
    }

private:
    std::vector<std::shared_ptr<const PixelMapSource>> sources_;
};

}  // namespace

std::unique_ptr<Engine> withViewMaps(std::unique_ptr<Engine> engine, const Scene& scene) {
    if (scene.mapSources.empty()) return engine;
    return std::make_unique<MappedEngine>(std::move(engine), scene);
}

}  // namespace tetralux::projection
