// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <tbb/task_arena.h>

#include <projection/core/engine_traits.h>
#include <projection/core/perturbed_isosurfaces.h>
#include <projection/core/scalar_range.h>
#include <projection/core/wrapped_engine.h>
#include <projection/cpu/cpu_engine.h>
#include <projection/frame/adaptive_opacity.h>
#include <projection/frame/engine_registry.h>
#include <projection/frame/sampled_engine.h>
#include <projection/frame/translucent_slices.h>
#include <projection/frame/view_maps.h>
#include <projection/gl/gl_engine.h>
#include <projection/light/light_frame.h>
#include <projection/reference/reference_engine.h>
#include <projection/repair/exact_repair.h>

namespace tetralux::projection {

namespace {

struct RegisteredEngine {
    const char* name;
    std::unique_ptr<Engine> (*make)(const Scene&, const EngineOptions&);
    EngineTraits traits;
};

// The first one is what "auto" takes.
constexpr std::array engines{
    RegisteredEngine{"cpu", makeCpuEngine, {}},
    RegisteredEngine{"gl", makeGlEngine, {.fromTable = true}},
    RegisteredEngine{"reference", makeReferenceEngine, {.perturbation = 0.0, .drawsTranslucent = true, .exact = true}},
};

/// Everything that a frame asks for in parallel runs in one arena: as many threads as were given, or as the caller's
/// has. Engines take whatever arena they find themselves in.
class ArenaEngine final : public WrappedEngine {
public:
    ArenaEngine(std::unique_ptr<tbb::task_arena> arena, std::unique_ptr<Engine> engine)
        : WrappedEngine(std::move(engine)), arena_(std::move(arena)) {}
    ~ArenaEngine() override {
        arena_->execute([&] { engine_.reset(); });
    }

    Image render(const View& view, FrameReport& report) override {
        return arena_->execute([&] { return engine_->render(view, report); });
    }
    std::string renderer() const override {
        return arena_->execute([&] { return engine_->renderer(); });
    }

private:
    std::unique_ptr<tbb::task_arena> arena_;
};

std::unique_ptr<Engine> makeEngineHere(const Scene& wanted, const EngineOptions& options);

}  // namespace

std::vector<std::string> engineNames() {
    std::vector<std::string> names;
    for (const auto& engine : engines) names.emplace_back(engine.name);
    return names;
}

std::unique_ptr<Engine> makeEngine(const Scene& scene, const EngineOptions& options) {
    const int threads = scene.settings.threads;
    if (threads == RenderSettings::threadsOfCaller) return makeEngineHere(scene, options);
    auto arena = std::make_unique<tbb::task_arena>(threads > 0 ? threads : int{tbb::task_arena::automatic});
    auto engine = arena->execute([&] { return makeEngineHere(scene, options); });
    return std::make_unique<ArenaEngine>(std::move(arena), std::move(engine));
}

namespace {

std::unique_ptr<Engine> makeEngineHere(const Scene& wanted, const EngineOptions& options) {
    const Scene scene = sceneOfSamples(withVertexLight(withScalarsInRange(wanted)));
    const std::string name = options.engine != "auto" ? options.engine : engines.front().name;
    for (const auto& engine : engines)
        if (name == engine.name) {
            const MakeEngine plain = [&](const Scene& part) {
                const EngineTraits& traits = engine.traits;
                const Scene drawn =
                    traits.perturbation > 0 ? withPerturbedIsosurfaces(part, traits.perturbation) : part;
                auto made = withExactRepair(engine.make(drawn, options), part, traits);
                return traits.drawsTranslucent ? std::move(made) : withTranslucentSlices(std::move(made));
            };
            auto drawn = isAdaptive(scene.settings) ? makeAdaptiveEngine(scene, plain) : plain(scene);
            return withSamples(withViewMaps(std::move(drawn), scene), wanted);
        }
    throw std::runtime_error(fmt::format("engine '{}': there is no such engine; take one of auto, {}", options.engine,
                                         fmt::join(engineNames(), ", ")));
}

}  // namespace

}  // namespace tetralux::projection
