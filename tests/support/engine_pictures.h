// SPDX-License-Identifier: Apache-2.0
/// \file
/// Pictures of one scene by every engine and context, held against the reference's.
#pragma once

#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <projection/frame/engine_registry.h>
#include <projection/reference/reference_ray_caster.h>

namespace tetralux::test {

struct EngineThreshold {
    double rmse, max;
};

/// The fast engines; `everyContext`: those of OpenGL in either kind of context.
inline std::vector<projection::EngineOptions> fastEngines(bool everyContext = false) {
    if (everyContext) return {{"cpu", "auto"}, {"gl", "egl"}, {"gl", "osmesa"}};
    return {{"cpu", "auto"}, {"gl", "auto"}};
}

inline projection::Image pictureOf(const projection::Scene& scene, const projection::View& view,
                                   const projection::EngineOptions& options) {
    projection::FrameReport report;
    return projection::makeEngine(scene, options)->render(view, report);
}

inline projection::Image referencePicture(const projection::Scene& scene, const projection::View& view) {
    return pictureOf(scene, view, {"reference", "auto"});
}

/// The reference's picture, which must show something: nothing is tested by an empty one.
inline projection::Image referenceThatShows(const projection::Scene& scene, const projection::View& view,
                                            const std::string& what = "") {
    projection::Image reference = referencePicture(scene, view);
    double strongest = 0;
    for (const glm::vec4& pixel : reference.pixels)
        for (int channel = 0; channel < 4; ++channel)
            strongest = std::max(strongest, static_cast<double>(pixel[channel]));
    EXPECT_GT(strongest, 0.05) << what << ": the picture is empty, nothing is tested";
    return reference;
}

/// One engine's picture is the reference's.
inline void expectLike(const projection::Image& reference, const projection::Scene& scene, const projection::View& view,
                       const projection::EngineOptions& options, EngineThreshold threshold,
                       const std::string& what = "") {
    const projection::ImageDifference difference =
        projection::compareImages(pictureOf(scene, view, options), reference);
    std::printf("%-44s %s %-7s rmse %.1e max %.1e\n", what.c_str(), options.engine.c_str(), options.context.c_str(),
                difference.rmse, difference.max);
    EXPECT_LE(difference.rmse, threshold.rmse) << what << ' ' << options.engine << ' ' << options.context;
    EXPECT_LE(difference.max, threshold.max) << what << ' ' << options.engine << ' ' << options.context;
}

/// Every fast engine's picture is the reference's, which shows something.
inline void expectEnginesAgree(const projection::Scene& scene, const projection::View& view, EngineThreshold threshold,
                               const std::string& what, bool everyContext = false) {
    const projection::Image reference = referenceThatShows(scene, view, what);
    for (const auto& options : fastEngines(everyContext)) expectLike(reference, scene, view, options, threshold, what);
}

}  // namespace tetralux::test
