// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <stdexcept>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <projection/core/lowered_isosurfaces.h>
#include <projection/core/scalar_range.h>
#include <projection/cpu/cpu_engine.h>
#include <projection/frame/adaptive_opacity.h>
#include <projection/frame/engine_registry.h>
#include <projection/frame/veiled_volume.h>
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
    double tie;  ///< lowered_isosurfaces.h
    bool veils;  ///< whether it draws PixelMaps::veils by itself
};

// The first one is what "auto" takes.
constexpr std::array engines{
    RegisteredEngine{"cpu", makeCpuEngine, floatTie, false}, RegisteredEngine{"gl", makeGlEngine, floatTie, false},
    RegisteredEngine{"reference", makeReferenceEngine, 0.0, true},  // its ray caster sees to ties
};

}  // namespace

std::vector<std::string> engineNames() {
    std::vector<std::string> names;
    for (const auto& engine : engines) names.emplace_back(engine.name);
    return names;
}

std::unique_ptr<Engine> makeEngine(const Scene& wanted, const EngineOptions& options) {
    const Scene scene = withVertexLight(withScalarsInRange(wanted));
    const std::string name = options.engine != "auto" ? options.engine : engines.front().name;
    for (const auto& engine : engines)
        if (name == engine.name) {
            const MakeEngine plain = [&](const Scene& part) {
                auto made = withExactRepair(
                    engine.make(engine.tie > 0 ? withTiesAbove(part, engine.tie) : part, options), part);
                return engine.veils ? std::move(made) : withVeils(std::move(made));
            };
            return withViewMaps(scene.settings.adaptive ? makeAdaptiveEngine(scene, plain) : plain(scene), scene);
        }
    throw std::runtime_error(fmt::format("engine '{}': there is no such engine; take one of auto, {}", options.engine,
                                         fmt::join(engineNames(), ", ")));
}

}  // namespace tetralux::projection
