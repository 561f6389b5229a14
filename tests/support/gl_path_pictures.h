// SPDX-License-Identifier: Apache-2.0
/// \file
/// Pictures of the OpenGL engine by its paths (projection/gl/gl_path.h), held against the streaming one's.
#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <projection/gl/gl_engine.h>
#include <projection/light/light_frame.h>
#include <tests/support/analytic_scenes.h>

namespace tetralux::test {

using namespace projection;

inline double waves(const glm::dvec3& p) {
    return 0.5 + 0.4 * std::sin(5 * p.x + 3 * p.y) * std::cos(4 * p.z);
}

struct PathPicture {
    Image image{1, 1};
    FrameReport report;
};

inline std::unique_ptr<Engine> engineOf(const Scene& scene, const std::string& path,
                                        const std::string& context = "auto") {
    EngineOptions options;
    options.context = context;
    options.glPath = path;
    return makeGlEngine(scene, options);
}

inline PathPicture pictureOf(Engine& engine, const View& view) {
    PathPicture picture;
    picture.image = engine.render(view, picture.report);
    return picture;
}

/// Float rounds records whose doubles agree; a last digit may differ where a driver contracts, and every segment of a
/// pixel carries one.
inline constexpr double roundingOnly = 1e-5;

/// `path` draws the views as "stream" does, of the same cells and fragments.
inline void expectSame(const Scene& scene, const std::vector<View>& views, const std::string& path,
                       const std::string& context) {
    const auto streaming = engineOf(scene, "stream", context), keeping = engineOf(scene, path, context);
    for (const View& view : views) {
        const PathPicture stream = pictureOf(*streaming, view), kept = pictureOf(*keeping, view);
        const double eye = view.camera.eye.x;
        EXPECT_LE(compareImages(stream.image, kept.image).max, roundingOnly) << eye << ' ' << context;
        EXPECT_EQ(stream.report.dataPath, "stream");
        EXPECT_EQ(kept.report.dataPath, path) << eye;
        EXPECT_EQ(stream.report.cellsDrawn, kept.report.cellsDrawn) << eye;
        EXPECT_EQ(stream.report.cellsSkipped, kept.report.cellsSkipped) << eye;
        EXPECT_EQ(stream.report.cellsSorted, kept.report.cellsSorted) << eye;
        EXPECT_EQ(stream.report.orderMethod, kept.report.orderMethod) << eye;
        EXPECT_GT(kept.report.cellsDrawn, 0u) << eye;
        EXPECT_GT(kept.report.fragments, 0u) << eye;
        // float may put a grazed pixel on either side; tiles stop at what is seen first
        const double fragments =
            static_cast<double>(kept.report.fragments) / static_cast<double>(stream.report.fragments);
        EXPECT_LE(fragments, 1.0 + 1e-3) << eye;
        const bool endsEarly = scene.settings.mode == Mode::FirstHit || scene.settings.mode == Mode::Depth ||
                               scene.settings.earlyTermination;
        const double least = path == "tiles" && endsEarly ? 0.0 : 1.0 - 1e-3;
        EXPECT_GE(fragments, least) << eye;
        double strongest = 0;
        for (const glm::vec4& pixel : stream.image.pixels)
            strongest = std::max({strongest, static_cast<double>(pixel.x), static_cast<double>(pixel.w)});
        EXPECT_GT(strongest, 0.05) << eye << ": the picture is empty, nothing is tested";
    }
}

inline void expectSame(const Scene& scene, const std::vector<View>& views, const std::string& path) {
    for (const std::string context : {"egl", "osmesa"}) expectSame(scene, views, path, context);
}

inline const std::vector<Mode> pathModes{Mode::Standard, Mode::ScaleInvariant, Mode::Mip,      Mode::Minimum,
                                         Mode::Average,  Mode::Additive,       Mode::Emission, Mode::Absorption,
                                         Mode::FirstHit, Mode::Depth};

/// In two lights, with silhouettes or with smooth normals, which vertices carry.
inline Scene litScene(int n, bool smooth) {
    Scene scene = sceneOf(jitteredBoxMesh(n, 0.2, 5, waves), smoothFunction(0.1, 0.9));
    scene.settings.shading.lights = {{glm::dvec3(0, 0, 1)}, {glm::dvec3(0.6, 0.8, 0)}};
    scene.settings.shading.silhouette = !smooth;
    if (!smooth) return scene;
    scene.settings.shading.normals = shading::Normals::Smooth;
    return withVertexLight(scene);
}

/// From outside, from between the cells, in parallel, and so near that outlines reach far beyond the image.
inline std::vector<View> views() {
    std::vector<View> all{cameraAt({1.9, 1.4, 2.3}), cameraAt({0.43, 0.51, 0.56}, {0.9, 0.6, 0.7}),
                          cameraAt({1.9, 1.4, 2.3}), cameraAt({0.5, 0.5, 1.0001}, {0.5, 0.52, 0.5})};
    all[1].camera.fovDegrees = 100;
    all[2].camera.orthographicHeight = 1.4;
    all[3].camera.fovDegrees = 2;
    return all;
}

/// A box of side `size` in n³ points, the eye before it, and one cell of size 1: whole-number keys, spread over all of
/// it, tell the box's cells apart only to 2⁻³². By centroids, which have keys for any mesh.
inline std::pair<Scene, Camera> clumpOfCells(int n, double size) {
    mesh::ScalarMesh m = boxMesh(n, waves);
    for (glm::dvec3& p : m.positions) p *= size;
    const auto first = static_cast<mesh::PointIndex>(m.positions.size());
    for (const glm::dvec3& p : {glm::dvec3(0.1, 0, 0), {1, 0, 0.1}, {0.2, 1, 0}, {0, 0.2, 1}}) {
        m.positions.push_back(p);
        m.scalars.push_back(0.7);
    }
    m.cells.push_back({first, first + 1, first + 2, first + 3});
    Scene scene = sceneOf(finished(std::move(m)), smoothFunction(0.1, 0.9, 2.5 / size));
    scene.settings.table.size = 32;
    scene.settings.order = OrderMethod::Centroid;
    return {scene, cameraAt(size * glm::dvec3(1.93, 1.37, 2.21), glm::dvec3(0.5 * size))};
}

}  // namespace tetralux::test
