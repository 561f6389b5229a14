// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <stdexcept>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <projection/adaptive_opacity.h>
#include <projection/cpu/cpu_engine.h>
#include <projection/engine.h>
#include <projection/gl/gl_engine.h>
#include <projection/light/light_frame.h>
#include <projection/opaque/veiled_volume.h>
#include <projection/order/exact_repair.h>
#include <projection/order/isosurface_ties.h>
#include <projection/reference/reference_engine.h>
#include <projection/scalar_range.h>
#include <projection/view_maps.h>

namespace tetralux::projection {

namespace {

struct RegisteredEngine {
    const char* name;
    std::unique_ptr<Engine> (*make)(const Scene&, const EngineOptions&);
    double tie;  ///< isosurface_ties.h
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
