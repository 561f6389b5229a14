// SPDX-License-Identifier: Apache-2.0
#include <projection/gl/gl_resolve.h>

#include <algorithm>
#include <cmath>

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

namespace tetralux::projection {

namespace {

constexpr float noMinimum = 2.0f;  // scene scalars are in [0, 1]

}  // namespace

float clearValue(Mode mode) {
    return mode == Mode::Mip ? -1.0f : mode == Mode::Minimum ? noMinimum : 0.0f;
}

std::vector<std::uint32_t> resolveOrderFree(Image& image, const GlGathered& frame, const ScalarColors& colors) {
    const Mode mode = frame.mode;
    if (!orderFree(mode) && mode != Mode::Depth) return {};
    tbb::enumerable_thread_specific<std::vector<std::uint32_t>> uncertain;
    const auto resolve = [&](const glm::vec4& gathered, std::uint32_t pixel) -> glm::vec4 {
        const auto colorOf = [&](bool met, float scalar) {
            if (!met) return glm::vec4(0);
            if (colors.isUncertain(scalar)) uncertain.local().push_back(pixel);
            return glm::vec4(glm::vec3(colors.at(scalar)), 1.0f);
        };
        switch (mode) {
            case Mode::Mip:
                return colorOf(gathered.x >= 0.0f, gathered.x);
            case Mode::Minimum:
                return colorOf(gathered.x < noMinimum, gathered.x);
            case Mode::Average:
                return colorOf(gathered.y > 0.0f, gathered.x / gathered.y);
            case Mode::Additive:
            case Mode::DataAdditive:
                return frame.sums ? gathered : glm::vec4(glm::vec3(gathered), std::min(gathered.w, 1.0f));
            case Mode::Emission:
                return {glm::vec3(gathered), 0.0f};
            case Mode::Absorption:
                return {0.0f, 0.0f, 0.0f, static_cast<float>(-std::expm1(-static_cast<double>(gathered.x)))};
            case Mode::Depth: {
                const double distance = (frame.depthReference + static_cast<double>(gathered.x)) * frame.length;
                return gathered.w > 0.0f ? glm::vec4(glm::vec3(static_cast<float>(frame.depths.greyAt(distance))), 1.0f)
                                         : glm::vec4(0);
            }
            default:
                return gathered;
        }
    };
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, image.pixels.size(), 4096), [&](const auto& part) {
        for (std::size_t i = part.begin(); i != part.end(); ++i)
            image.pixels[i] = resolve(image.pixels[i], static_cast<std::uint32_t>(i));
    });
    std::vector<std::uint32_t> all;
    for (const auto& part : uncertain) all.insert(all.end(), part.begin(), part.end());
    return all;
}

}  // namespace tetralux::projection
