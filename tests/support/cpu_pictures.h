// SPDX-License-Identifier: Apache-2.0
/// \file
/// Pictures of the tile engine, also with shortcuts switched off.
#pragma once

#include <string>

#include <gtest/gtest.h>

#include <projection/core/camera.h>
#include <projection/core/scene.h>
#include <projection/cpu/cpu_engine.h>
#include <projection/image/image.h>
#include <projection/reference/reference_ray_caster.h>
#include <tests/support/engine_pictures.h>

namespace tetralux::test {

/// What the engine makes no number since it cannot vouch for it is composed by the reference, and is little.
inline projection::Image cpuImage(const projection::Scene& scene, const projection::Camera& camera,
                                  projection::FrameReport& report, const projection::CpuSkips& skips = {}) {
    projection::Image image = projection::makeCpuEngineWith(scene, skips)->render(camera, report);
    const auto pixels = projection::pixelsNotFinite(image);
    EXPECT_LE(pixels.size(), image.pixels.size() / 50);
    if (!pixels.empty()) projection::ReferenceRayCaster(scene).renderPixels(camera, pixels, image);
    return image;
}

inline projection::Image cpuImage(const projection::Scene& scene, const projection::Camera& camera,
                                  const projection::CpuSkips& skips = {}) {
    projection::FrameReport report;
    return cpuImage(scene, camera, report, skips);
}

inline projection::Camera wholeView(const mesh::ScalarMesh& m, int width = 52, int height = 45) {
    projection::Camera camera;
    camera.width = width;
    camera.height = height;
    camera.target = m.bounds.centre();
    camera.eye = projection::threeQuarterEye(m.bounds, camera);
    return camera;
}

/// The kernels for common lights and silhouettes against the general one.
inline void expectLikeGeneral(const projection::Scene& scene, const projection::Camera& camera,
                              EngineThreshold threshold, const std::string& what) {
    const projection::ImageDifference difference =
        projection::compareImages(cpuImage(scene, camera), cpuImage(scene, camera, {.quickVariants = false}));
    EXPECT_LE(difference.rmse, threshold.rmse) << what;
    EXPECT_LE(difference.max, threshold.max) << what;
    EXPECT_GT(difference.max, 0.0) << what << ": the same kernel drew both";
}

}  // namespace tetralux::test
