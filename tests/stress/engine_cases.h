// SPDX-License-Identifier: Apache-2.0
/// \file
/// Runs every engine that this machine has on a scene and holds it to a picture that is known.
#pragma once

#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <projection/frame/engine_registry.h>
#include <projection/reference/reference_ray_caster.h>
#include <tests/support/analytic_scenes.h>

namespace tetralux::test {

/// Engines and contexts under test: the reference counts among them where the expectation is analytic.
inline std::vector<projection::EngineOptions> enginesUnderTest() {
    std::vector<projection::EngineOptions> all;
    for (const std::string& name : projection::engineNames()) {
        projection::EngineOptions options;
        options.engine = name;
        all.push_back(options);
    }
    return all;
}

struct Threshold {
    double rmse, max;
};

inline projection::Image referenceImage(const projection::Scene& scene, const projection::Camera& camera) {
    projection::RayCastCounts counts;
    return projection::ReferenceRayCaster(scene).render(camera, counts);
}

/// Renders and compares with `expected`; prints the errors. `what` names the case.
inline void holdPictureTo(const projection::Image& expected, projection::Engine& engine,
                          const projection::Camera& camera, Threshold threshold, const std::string& what) {
    projection::FrameReport report;
    const projection::Image image = engine.render(camera, report);
    for (const glm::vec4& pixel : image.pixels)
        for (int channel = 0; channel < 4; ++channel)
            ASSERT_TRUE(std::isfinite(pixel[channel])) << "a pixel is not finite";
    const projection::ImageDifference difference = projection::compareImages(image, expected);
    std::printf("%-58s %-10s rmse %.1e max %.1e repaired %llu\n", what.c_str(), engine.name().c_str(), difference.rmse,
                difference.max, static_cast<unsigned long long>(report.pixelsRepaired));
    EXPECT_LE(difference.rmse, threshold.rmse);
    EXPECT_LE(difference.max, threshold.max);
    EXPECT_EQ(report.pixelsWrong, 0u);
}

/// The same by every engine.
inline void holdEnginesTo(const projection::Image& expected, const projection::Scene& scene,
                          const projection::Camera& camera, Threshold threshold, const std::string& what) {
    for (const auto& options : enginesUnderTest()) {
        SCOPED_TRACE(what + ", engine " + options.engine);
        holdPictureTo(expected, *projection::makeEngine(scene, options), camera, threshold, what);
    }
}

/// How much of the picture is not empty, so that no case passes on a black one.
inline double coveredShare(const projection::Image& image) {
    double covered = 0;
    for (const glm::vec4& pixel : image.pixels) covered += pixel.w > 1e-6f ? 1 : 0;
    return covered / static_cast<double>(image.pixels.size());
}

}  // namespace tetralux::test
