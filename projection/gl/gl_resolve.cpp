// SPDX-License-Identifier: Apache-2.0
#include <projection/gl/gl_resolve.h>

#include <algorithm>
#include <cmath>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

namespace tetralux::projection {

namespace {

constexpr float noMinimum = 2.0f;  // scene scalars are in [0, 1]

/// The colour of one scalar, in scene units.
glm::vec4 scalarColor(const preint::TransferFunction& function, const SceneUnits& units, double scalar) {
    return {glm::vec3(function.colorAt(units.scalarOffset + scalar * units.scalarScale)), 1.0f};
}

}  // namespace

float clearValue(Mode mode) {
    return mode == Mode::Mip ? -1.0f : mode == Mode::Minimum ? noMinimum : 0.0f;
}

void resolveOrderFree(Image& image, const Scene& scene, const Camera& camera, const SceneUnits& units) {
    const Mode mode = scene.settings.mode;
    if (!orderFree(mode) && mode != Mode::Depth) return;
    const DepthRange range = depthRange(scene.mesh->bounds, camera);
    const auto resolve = [&](const glm::vec4& gathered) -> glm::vec4 {
        const double first = static_cast<double>(gathered.x), second = static_cast<double>(gathered.y);
        const auto colorOf = [&](double scalar) { return scalarColor(scene.transferFunction, units, scalar); };
        switch (mode) {
            case Mode::Mip:
                return gathered.x >= 0.0f ? colorOf(first) : glm::vec4(0);
            case Mode::Minimum:
                return gathered.x < noMinimum ? colorOf(first) : glm::vec4(0);
            case Mode::Average:
                return gathered.y > 0.0f ? colorOf(first / second) : glm::vec4(0);
            case Mode::Additive:
            case Mode::DataAdditive:
                return scene.settings.contributions.sums ? gathered
                                                         : glm::vec4(glm::vec3(gathered), std::min(gathered.w, 1.0f));
            case Mode::Emission:
                return {glm::vec3(gathered), 0.0f};
            case Mode::Absorption:
                return {0.0f, 0.0f, 0.0f, static_cast<float>(-std::expm1(-first))};
            case Mode::Depth:
                return gathered.w > 0.0f
                           ? glm::vec4(glm::vec3(static_cast<float>(range.greyAt(first * units.length))), 1.0f)
                           : glm::vec4(0);
            default:
                return gathered;
        }
    };
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, image.pixels.size(), 4096), [&](const auto& part) {
        for (std::size_t i = part.begin(); i != part.end(); ++i) image.pixels[i] = resolve(image.pixels[i]);
    });
}

}  // namespace tetralux::projection
