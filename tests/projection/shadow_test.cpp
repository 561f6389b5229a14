// SPDX-License-Identifier: Apache-2.0
//
// Shadows of the volume: transmittance at vertices against closed forms, also on the boundary and where light runs
// along faces; isosurfaces, which shade others but not themselves.
#include <random>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include <projection/core/clip_region.h>
#include <projection/light/light_frame.h>
#include <projection/light/light_shadows.h>
#include <tests/support/analytic_scenes.h>
#include <tests/support/engine_pictures.h>

namespace tetralux::projection {
namespace {

using namespace tetralux::test;

constexpr double extinction = 2.0;
constexpr double infinity = std::numeric_limits<double>::infinity();

shading::Light directional(const glm::dvec3& towards) {
    shading::Light light;
    light.towards = glm::normalize(towards);
    return light;
}
shading::Light point(const glm::dvec3& position) {
    shading::Light light;
    light.kind = shading::Light::Kind::Point;
    light.position = position;
    return light;
}

/// Transmittance at every vertex to the scene's first light.
std::vector<double> vertexShadows(const Scene& scene) {
    const auto light = vertexLightOf(scene);
    std::vector<double> shadows;
    for (std::size_t i = 0; i < scene.mesh->positions.size(); ++i)
        shadows.push_back(static_cast<double>(light->of(i)[light->shadowAt]));
    return shadows;
}

Scene shadowScene(const mesh::ScalarMesh& m, const preint::TransferFunction& function, const shading::Light& light) {
    Scene scene = sceneOf(m, function);
    scene.settings.shading.lights = {light};
    scene.settings.shading.shadows.on = true;
    return scene;
}

/// A parallelepiped: the unit cube, mapped.
struct Box {
    glm::dmat3 worldFromCube{1};
    glm::dvec3 origin{0};

    /// From a place in it, on its boundary too, along a direction to where the box ends, at most `reach`.
    double way(const glm::dvec3& place, const glm::dvec3& direction, double reach) const {
        const glm::dmat3 cubeFromWorld = glm::inverse(worldFromCube);
        const glm::dvec3 at = cubeFromWorld * (place - origin), d = cubeFromWorld * direction;
        constexpr double rounding = 1e-6;  // of positions and directions
        double end = reach;
        for (int axis = 0; axis < 3; ++axis)
            if (std::abs(d[axis]) > rounding * glm::length(d))
                end = std::min(end, std::max(0.0, ((d[axis] > 0 ? 1.0 : 0.0) - at[axis]) / d[axis]));
        return end;
    }
    mesh::ScalarMesh mesh(int n, bool floats = false) const {
        mesh::ScalarMesh m = boxMesh(n, [](const glm::dvec3& p) { return p.x - 0.4 * p.y; });
        for (glm::dvec3& p : m.positions) {
            p = worldFromCube * p + origin;
            if (floats) p = glm::dvec3(glm::vec3(p));
        }
        return finished(std::move(m));
    }
};

double worstError(const Box& box, const mesh::ScalarMesh& m, const shading::Light& light) {
    const auto shadows = vertexShadows(shadowScene(m, constantFunction(extinction), light));
    double worst = 0;
    for (std::size_t i = 0; i < shadows.size(); ++i) {
        const glm::dvec3 p = m.positions[i];
        const bool near = light.kind == shading::Light::Kind::Point;
        const glm::dvec3 way = near ? light.position - p : light.towards;
        const double reach = near ? glm::length(way) : infinity;
        if (reach == 0) continue;
        worst = std::max(worst, std::abs(shadows[i] - std::exp(-extinction * box.way(p, glm::normalize(way), reach))));
    }
    return worst;
}

/// Along edges, diagonals of faces and of cubes, faces, and none of them.
std::vector<glm::dvec3> directions() {
    std::vector<glm::dvec3> all;
    for (int z = -1; z <= 1; ++z)
        for (int y = -1; y <= 1; ++y)
            for (int x = -1; x <= 1; ++x)
                if (x != 0 || y != 0 || z != 0) all.emplace_back(x, y, z);
    for (const glm::dvec3& d : {glm::dvec3(1, 2, 0), {0, -1, 3}, {2, 1, 1}, {1, 2, 3}, {-0.3, 0.71, 0.45}})
        all.push_back(d);
    return all;
}

TEST(Shadows, OfAUniformBoxAtEveryVertex) {
    const Box box;
    const mesh::ScalarMesh m = box.mesh(17);
    for (const glm::dvec3& towards : directions())
        EXPECT_LE(worstError(box, m, directional(towards)), 1e-4) << towards.x << ' ' << towards.y << ' ' << towards.z;
}

// Turned and sheared, so that nothing is along the axes and rounding moves vertices out of the faces that light runs
// along; in floats as well, as most files hold them.
TEST(Shadows, OfAParallelepiped) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> some(-1, 1);
    for (const bool floats : {false, true})
        for (int i = 0; i < 4; ++i) {
            Box box;
            for (int column = 0; column < 3; ++column)
                box.worldFromCube[column] += 0.4 * glm::dvec3(some(random), some(random), some(random));
            box.origin = {some(random), some(random), some(random)};
            const mesh::ScalarMesh m = box.mesh(7, floats);
            for (const glm::dvec3& towards : directions())
                EXPECT_LE(worstError(box, m, directional(box.worldFromCube * towards)), 1e-4)
                    << floats << i << ' ' << towards.x << ' ' << towards.y << ' ' << towards.z;
        }
}

// In the planes of faces, at vertices, inside and outside.
TEST(Shadows, OfPointLightsInAUniformBox) {
    const Box box;
    const mesh::ScalarMesh m = box.mesh(9);
    for (const glm::dvec3& place : {glm::dvec3(0.5, 0.5, 2),
                                    {0, 0, 3},
                                    {1, 0.25, 1},
                                    {0.5, 0.5, 0.5},
                                    {0.3, 0.41, 0.77},
                                    {0, 0, 0},
                                    {0.5, 1, 0.5},
                                    {-1, -1, -1},
                                    {1.5, 0.375, 0.625}})
        EXPECT_LE(worstError(box, m, point(place)), 1e-4) << place.x << ' ' << place.y << ' ' << place.z;
}

// Over the disc of an area light, which a face divides into halves: by many more points than the light's 32, of which
// one stands for 0.03.
TEST(Shadows, OfAreaLightsInAUniformBox) {
    const Box box;
    const mesh::ScalarMesh m = box.mesh(5);
    for (const glm::dvec3& towards : {glm::dvec3(0, 0, 1), {1, 1, 0}, {0.2, 0.5, 0.6}}) {
        Scene scene = shadowScene(m, constantFunction(extinction), directional(towards));
        scene.settings.shading.shadows.softness = 0.3;
        const auto shadows = vertexShadows(scene);
        const glm::dvec3 d = glm::normalize(towards), a = glm::normalize(glm::cross(d, {0.3, -0.5, 0.8})),
                         b = glm::cross(d, a);
        for (std::size_t i = 0; i < shadows.size(); ++i) {
            double sum = 0;
            constexpr int points = 4000;
            for (int k = 0; k < points; ++k) {
                const double radius = 0.3 * std::sqrt((k + 0.5) / points), angle = 2.399963229728653 * k;
                const glm::dvec3 way = d + radius * (std::cos(angle) * a + std::sin(angle) * b);
                sum += std::exp(-extinction * box.way(m.positions[i], glm::normalize(way), infinity));
            }
            EXPECT_NEAR(shadows[i], sum / points, 0.03) << i << ' ' << towards.x << ' ' << towards.z;
        }
    }
}

// Light along the faces of inner cells whose scalars differ: with cell data each layer has an extinction of its own.
TEST(Shadows, AlongFacesBetweenCells) {
    mesh::ScalarMesh m = boxMesh(9, [](const glm::dvec3&) { return 0.0; });
    m.association = mesh::Association::Cell;
    m.scalars.clear();
    for (const mesh::Tetrahedron& cell : m.cells) {
        double z = 0;
        for (const auto p : cell) z += 0.25 * m.positions[p].z;
        m.scalars.push_back(std::floor(8 * z));
    }
    preint::TransferFunction function = constantFunction(0);
    function.extinction = {{0, 0.5}, {8, 4.5}};
    m = finished(std::move(m));
    const auto shadows = vertexShadows(shadowScene(m, function, directional({1, 0, 0})));
    for (std::size_t i = 0; i < shadows.size(); ++i) {
        const glm::dvec3& p = m.positions[i];
        const auto through = [&](double layer) {
            return std::exp(-(0.5 + 0.5 * std::clamp(layer, 0.0, 7.0)) * (1 - p.x));
        };
        const double layer = std::round(8 * p.z), below = through(layer - 1), above = through(layer);
        EXPECT_LE(std::min(std::abs(shadows[i] - below), std::abs(shadows[i] - above)), 1e-4) << i;
    }
}

// What clip planes leave out is not there for light either: slabs of fog, and a surface that shades nothing any more.
TEST(Shadows, AreNotCastByWhatIsCutOff) {
    const mesh::ScalarMesh m = boxMesh(9, [](const glm::dvec3& p) { return p.z; });
    Scene scene = shadowScene(m, constantFunction(extinction), directional({0, 0, 1}));
    scene.transferFunction.isosurfaces = {{0.3, 0.4, {1, 1, 1}}, {0.8, 0.9, {1, 1, 1}}};
    scene.mapSources = {std::make_shared<ClipRegion>(slabHalfSpaces({0.5, 0.5, 0.4}, {0, 0, 1}, 0.5), 0.01)};
    const auto shadows = vertexShadows(scene);
    for (std::size_t i = 0; i < shadows.size(); ++i) {
        const double z = m.positions[i].z, way = std::max(0.0, 0.65 - std::max(z, 0.15));
        EXPECT_NEAR(shadows[i], std::exp(-extinction * way) * (z < 0.3 ? 0.6 : 1.0), 1e-4) << z;
    }
}

double fromMiddle(const glm::dvec3& p) {
    return glm::distance(p, glm::dvec3(0.5));
}

Scene ofSurfaces(const mesh::ScalarMesh& m, const std::vector<preint::Isosurface>& surfaces,
                 const glm::dvec3& towards) {
    Scene scene = shadowScene(m, constantFunction(0), directional(towards));
    scene.transferFunction.isosurfaces = surfaces;
    scene.settings.shading.ambient = 0;
    return scene;
}

/// The largest difference that shadows make to the reference's picture.
double shadowIn(Scene scene, const Camera& camera) {
    const Image with = referenceThatShows(scene, camera);
    scene.settings.shading.shadows.on = false;
    return compareImages(with, referencePicture(scene, camera)).max;
}

// What is convex has no shadow on the side of the light, and nothing is reflected by the other.
TEST(Shadows, NoIsosurfaceShadesItself) {
    const Camera camera = cameraAt({1.9, 1.4, 2.3});
    for (const glm::dvec3& towards : {glm::dvec3(1, 1, 1), {0, 0, 1}, {-1, 0.3, 0.2}, {1, -1, 0}}) {
        const std::vector<preint::Isosurface> opaque{{0.31, 1.0, {1, 0.5, 0.2}}};
        EXPECT_LE(shadowIn(ofSurfaces(boxMesh(13, fromMiddle), opaque, towards), camera), 1e-5) << towards.x;
        EXPECT_LE(shadowIn(ofSurfaces(jitteredBoxMesh(9, 0.3, 3, fromMiddle), opaque, towards), camera), 1e-5);
        // two in the same cells, the inner one hidden: the outer one's light is all that is seen
        const std::vector<preint::Isosurface> nested{{0.30, 1.0, {0, 0, 1}}, {0.33, 1.0, {1, 0.5, 0.2}}};
        EXPECT_LE(shadowIn(ofSurfaces(boxMesh(9, fromMiddle), nested, towards), camera), 1e-5) << towards.x;
    }
    // through vertices, whose scalars are the isosurface's value: in the cells of one side
    const auto height = [](const glm::dvec3& p) { return p.z; };
    for (const double z : {1.0, -1.0})
        EXPECT_LE(shadowIn(ofSurfaces(boxMesh(9, height), {{0.5, 1.0, {1, 1, 1}}}, {0.3, 0.2, z}),
                           cameraAt({0.9, 0.8, z * 3})),
                  1e-5);
}

// Layers in shadow of those before them: each is lit through what stands between it and the light.
TEST(Shadows, OfIsosurfacesUponEachOther) {
    const auto height = [](const glm::dvec3& p) { return p.z; };
    const std::vector<preint::Isosurface> layers{{0.2, 0.5, {1, 1, 1}}, {0.5, 0.4, {1, 1, 1}}, {0.8, 0.3, {1, 1, 1}}};
    for (const int n : {4, 9}) {
        // seen from the dark side, along the light: transmission, α(1 − α)(c + 1) of each, by the light that comes to
        // it
        const Scene scene = ofSurfaces(boxMesh(n, height), layers, {0, 0, 1});
        Camera camera = cameraAt({0.5, 0.5, -3}, glm::dvec3(0.5), 8, 8);
        camera.orthographicHeight = 0.8;
        double through = 1, light = 0, left = 0.5 * 0.6 * 0.7;
        for (const auto& layer : layers) {
            left /= 1 - layer.opacity;  // of the layers between it and the light
            light += through * layer.opacity * (1 - layer.opacity) * 2 * left;
            through *= 1 - layer.opacity;
        }
        for (const EngineOptions& options : {EngineOptions{"reference", "auto"}, {"cpu", "auto"}, {"gl", "auto"}}) {
            const Image image = pictureOf(scene, camera, options);
            for (const glm::vec4& pixel : image.pixels) EXPECT_NEAR(pixel.x, light, 1e-4) << options.engine << n;
        }
    }
}

// One ball between another one and the light: all of its shadow, but for cells at the rim.
TEST(Shadows, OfOneBallUponAnother) {
    const glm::dvec3 near(0.5, 0.5, 0.72), far(0.5, 0.5, 0.22);  // of radius 0.2 and 0.15
    const auto balls = [&](const glm::dvec3& p) {
        return std::min(0.75 * glm::distance(p, near), glm::distance(p, far));
    };
    Scene scene = ofSurfaces(boxMesh(33, balls), {{0.15, 1.0, {1, 1, 1}}}, {0, 0, 1});
    scene.settings.shading.exponent = 1;
    const Camera camera = cameraAt({0.5, 3.5, 0.5 + 1e-3});
    const Image with = referenceThatShows(scene, camera);
    scene.settings.shading.shadows.on = false;
    const Image without = referencePicture(scene, camera);
    const CameraFrame frame = cameraFrame(camera);
    int lit = 0, dark = 0;
    for (int y = 0; y < camera.height; ++y)
        for (int x = 0; x < camera.width; ++x) {
            if (without.at(x, y).x < 0.1) continue;
            const Ray ray = pixelRay(frame, x, y);
            const bool first = glm::length(glm::cross(near - ray.origin, ray.direction)) < 0.19;
            const bool hidden = glm::length(glm::cross(far - ray.origin, ray.direction)) < 0.14;
            if (first) {
                EXPECT_NEAR(with.at(x, y).x, without.at(x, y).x, 1e-5);
                ++lit;
            } else if (hidden) {
                EXPECT_LE(with.at(x, y).x, 0.01 * without.at(x, y).x);
                ++dark;
            }
        }
    EXPECT_GT(lit, 10);
    EXPECT_GT(dark, 10);
}

// Rows that cells with isosurfaces have of their own reach every engine and path; so do silhouettes of smoothed
// gradients.
TEST(Shadows, EnginesAgree) {
    for (const Mode mode : {Mode::Standard, Mode::ScaleInvariant}) {
        Scene scene = sceneOf(jitteredBoxMesh(9, 0.2, 3, fromMiddle), smoothFunction(0, 0.87, 3.0), mode);
        scene.transferFunction.isosurfaces = {{0.22, 0.4, {1, 1, 0.5}}, {0.26, 0.7, {0.5, 1, 1}}};
        scene.settings.shading.lights = {directional({1, 1, 1}), point({0.9, 1.5, -0.3})};
        scene.settings.shading.shadows.on = true;
        scene.settings.shading.silhouette = true;
        scene.settings.shading.normals = shading::Normals::Smooth;
        scene = withVertexLight(scene);
        ASSERT_FALSE(scene.vertexLight->corners.empty());
        const Camera camera = cameraAt({1.9, 1.4, 2.3});
        const Image reference = referenceThatShows(scene, camera);
        // silhouettes multiply what tables are off by k
        for (const EngineOptions& options : {EngineOptions{"cpu", "auto"},
                                             {"gl", "auto", "stream"},
                                             {"gl", "auto", "resident"},
                                             {"gl", "auto", "tiles"}})
            expectLike(reference, scene, camera, options, {5e-5, 2e-3}, "shadows " + options.glPath);
    }
}

}  // namespace
}  // namespace tetralux::projection
