// SPDX-License-Identifier: Apache-2.0
//
// Slices and surfaces in a cube whose scalar is linear throughout: along a ray the volume is one exact segment from
// where the ray enters the cube to where it meets what is opaque.
#include <projection/opaque/opaque_layer.h>

#include <cmath>
#include <functional>
#include <limits>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include <preint/exact_integral.h>
#include <projection/frame/engine_registry.h>
#include <tests/support/analytic_scenes.h>

namespace tetralux::projection {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

double linear(const glm::dvec3& x) {
    return 0.2 + 0.5 * x.x + 0.25 * x.y - 0.125 * x.z;
}

struct Expected {
    double distance = infinite;
    glm::dvec3 color{0};
    int object = -1;
};
using Trace = std::function<Expected(const Ray&)>;

/// A slice through `point`, seen where the ray is inside the unit cube.
Expected traceSlice(const Ray& ray, const Slice& slice, const preint::TransferFunction& function, int object) {
    const double t = glm::dot(slice.point - ray.origin, slice.normal) / glm::dot(ray.direction, slice.normal);
    const auto [in, out] = test::pathInBox(ray, glm::dvec3(0), glm::dvec3(1));
    if (!(t > in) || !(t < out)) return {};
    return {t, function.colorAt(linear(ray.origin + t * ray.direction)), object};
}

/// The box [0.3, 0.6]³ in a flat colour.
mesh::SurfaceMesh smallBox() {
    mesh::SurfaceMesh box;
    for (const double z : {0.3, 0.6})
        for (const double y : {0.3, 0.6})
            for (const double x : {0.3, 0.6}) box.positions.emplace_back(x, y, z);
    const mesh::PointIndex faces[6][4] = {{0, 1, 3, 2}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                          {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 3, 7, 5}};
    for (const auto& f : faces) {
        box.triangles.push_back({f[0], f[1], f[2]});
        box.triangles.push_back({f[0], f[2], f[3]});
    }
    return box;
}

const glm::dvec3 boxColor{0.9, 0.2, 0.1};

Expected traceBox(const Ray& ray, int object) {
    const auto [in, out] = test::pathInBox(ray, glm::dvec3(0.3), glm::dvec3(0.6));
    if (!(in < out)) return {};
    return {in > 0 ? in : out, boxColor, object};
}

/// Pixels beside which another object shows, or nothing, are edges: there a ray beside the centre may see either.
bool isEdge(const std::vector<Expected>& seen, int width, int height, int x, int y) {
    for (const auto& [dx, dy] : {std::pair(1, 0), std::pair(-1, 0), std::pair(0, 1), std::pair(0, -1)}) {
        const int nx = x + dx, ny = y + dy;
        if (nx < 0 || ny < 0 || nx >= width || ny >= height) continue;
        if (seen[static_cast<std::size_t>(ny * width + nx)].object !=
            seen[static_cast<std::size_t>(y * width + x)].object)
            return true;
    }
    return false;
}

/// Renders by every engine and holds each pixel to the closed form. Returns how many pixels with something opaque were
/// compared.
int holdToClosedForm(const Scene& scene, const Camera& camera, const Trace& trace, double tolerance) {
    const preint::ExactIntegral exact(scene.transferFunction);
    const CameraFrame frame = cameraFrame(camera);
    std::vector<Expected> seen;
    for (int y = 0; y < camera.height; ++y)
        for (int x = 0; x < camera.width; ++x) seen.push_back(trace(pixelRay(frame, x, y)));
    int compared = 0;
    for (const std::string& name : engineNames()) {
        compared = 0;
        FrameReport report;
        EngineOptions options;
        options.engine = name;
        const Image image = makeEngine(scene, options)->render(camera, report);
        double worst = 0;
        for (int y = 0; y < camera.height; ++y)
            for (int x = 0; x < camera.width; ++x) {
                if (isEdge(seen, camera.width, camera.height, x, y)) continue;
                const Ray ray = pixelRay(frame, x, y);
                const Expected& hit = seen[static_cast<std::size_t>(y * camera.width + x)];
                auto [in, out] = test::pathInBox(ray, glm::dvec3(0), glm::dvec3(1));
                out = std::min(out, hit.distance);
                glm::dvec4 expected(0);
                if (out > in) {
                    const auto segment =
                        exact.segment(linear(ray.origin + in * ray.direction), linear(ray.origin + out * ray.direction),
                                      out - in, integralOf(scene.settings.mode));
                    expected = {segment.color, segment.opacity()};
                }
                if (hit.object >= 0) {
                    expected += (1.0 - expected.w) * glm::dvec4(hit.color, 1.0);
                    ++compared;
                }
                for (int channel = 0; channel < 4; ++channel)
                    worst = std::max(worst, std::abs(expected[channel] - static_cast<double>(image.at(x, y)[channel])));
            }
        std::printf("%-10s max %.1e\n", name.c_str(), worst);
        EXPECT_LE(worst, tolerance) << name;
    }
    return compared;
}

Scene withObjects(Scene scene, const OpaqueObjects& objects) {
    scene.mapSources.push_back(std::make_shared<const OpaqueLayer>(scene, objects));
    return scene;
}

/// Smooth, with an isosurface.
preint::TransferFunction hybridFunction() {
    preint::TransferFunction function = test::smoothFunction(0.0, 1.0, 4.0);
    function.isosurfaces = {{0.4, 0.5, {0.2, 0.9, 0.9}}};
    return function;
}

// Table error 1e-4 wanted; 1e-4 away from edges is what engines must hold in such pictures.
constexpr double hybridTolerance = 1e-4;

TEST(OpaqueLayer, SliceIsosurfaceAndVolumeInOnePicture) {
    const preint::TransferFunction function = hybridFunction();
    const Slice slices[] = {{{0.5, 0.5, 0.45}, {0.2, -0.1, 1}}, {{0.5, 0.4, 0.5}, {0, 1, 0.2}}};
    for (const Mode mode : {Mode::Standard, Mode::ScaleInvariant}) {
        const Scene scene = withObjects(test::sceneOf(test::jitteredBoxMesh(7, 0.3, 5, linear), function, mode),
                                        {{slices[0], slices[1]}, {}});
        const int compared = holdToClosedForm(
            scene, test::cameraAt({2.1, 1.7, 2.6}),
            [&](const Ray& ray) {
                const Expected a = traceSlice(ray, slices[0], function, 0), b = traceSlice(ray, slices[1], function, 1);
                return a.distance < b.distance ? a : b;
            },
            hybridTolerance);
        EXPECT_GT(compared, 300);
    }
}

TEST(OpaqueLayer, SurfaceInTheVolumeIsDepthCorrect) {
    OpaqueSurface box;
    box.mesh = std::make_shared<const mesh::SurfaceMesh>(smallBox());
    box.color = boxColor;
    box.flat = true;
    const Slice slice{{0.5, 0.5, 0.45}, {0, 0, 1}};
    const preint::TransferFunction function = hybridFunction();
    const Scene scene =
        withObjects(test::sceneOf(test::jitteredBoxMesh(7, 0.3, 5, linear), function), {{slice}, {box}});
    const auto trace = [&](const Ray& ray) {
        const Expected a = traceSlice(ray, slice, function, 0), b = traceBox(ray, 1);
        return a.distance < b.distance ? a : b;
    };
    EXPECT_GT(holdToClosedForm(scene, test::cameraAt({2.1, 1.7, 2.6}), trace, hybridTolerance), 300);
    // from within the cube, and from within the box
    EXPECT_GT(holdToClosedForm(scene, test::cameraAt({0.9, 0.85, 0.95}, {0.4, 0.4, 0.4}), trace, hybridTolerance), 300);
    EXPECT_GT(holdToClosedForm(scene, test::cameraAt({0.5, 0.45, 0.55}, {0.2, 0.4, 0.1}), trace, hybridTolerance), 300);
    Camera orthographic = test::cameraAt({2.1, 1.7, 2.6});
    orthographic.orthographicHeight = 1.6;
    EXPECT_GT(holdToClosedForm(scene, orthographic, trace, hybridTolerance), 300);
}

TEST(OpaqueLayer, NoRaySlipsThroughTheSeams) {
    // A slice along the grid's own faces, seen straight on: every pixel's ray runs through edges or vertices.
    const Scene scene = withObjects(test::sceneOf(test::boxMesh(9, linear), test::constantFunction(0.0)),
                                    {{{{0.5, 0.5, 0.5}, {0, 0, 1}}}, {}});
    Camera camera = test::cameraAt({0.5, 0.5, 3}, {0.5, 0.5, 0.5}, 33, 33);
    camera.orthographicHeight = 33.0 / 32.0;  // pixel centres are 1/32 apart, from edge to edge of the cube
    PixelMaps maps;
    scene.mapSources.front()->apply(camera, maps);
    ASSERT_EQ(maps.behind.size(), 33u * 33u);
    for (int y = 1; y < 32; ++y)
        for (int x = 1; x < 32; ++x) {
            const auto pixel = static_cast<std::size_t>(y * 33 + x);
            EXPECT_NEAR(maps.farthest[pixel], 2.5, 1e-12) << x << ", " << y;
            EXPECT_EQ(maps.behind[pixel].w, 1.0f) << x << ", " << y;
        }
}

TEST(OpaqueLayer, SlicesShowTheCellsOwnValue) {
    mesh::ScalarMesh cube = test::boxMesh(3, linear);
    cube.association = mesh::Association::Cell;
    cube.scalars.assign(cube.cells.size(), 0.25);
    preint::TransferFunction function = test::constantFunction(0.0);
    function.color = {{0.0, {0, 0, 0}}, {1.0, {1, 0.5, 0.2}}};
    const Scene scene =
        withObjects(test::sceneOf(test::finished(std::move(cube)), function), {{{{0.5, 0.5, 0.4}, {0, 0, 1}}}, {}});
    PixelMaps maps;
    scene.mapSources.front()->apply(test::cameraAt({0.5, 0.5, 3}, glm::dvec3(0.5), 9, 9), maps);
    const glm::vec4 middle = maps.behind[4 * 9 + 4];
    EXPECT_NEAR(middle.x, 0.25, 1e-6);
    EXPECT_NEAR(middle.y, 0.125, 1e-6);
}

TEST(OpaqueLayer, ClippingLeavesOutSlicesNotSurfaces) {
    OpaqueSurface box;
    box.mesh = std::make_shared<const mesh::SurfaceMesh>(smallBox());
    box.flat = true;
    const Scene scene = test::sceneOf(test::boxMesh(5, linear), test::constantFunction(1.0));
    const Camera camera = test::cameraAt({0.5, 0.5, 3}, {0.5, 0.5, 0.5}, 9, 9);
    const std::size_t middle = 4 * 9 + 4;
    const auto farthest = [&](const OpaqueObjects& objects, double near, double far) {
        PixelMaps maps;
        maps.nearest.assign(81, near);
        maps.farthest.assign(81, far);
        OpaqueLayer(scene, objects).apply(camera, maps);
        return maps.behind.empty() || maps.behind[middle].w == 0.0f ? infinite : maps.farthest[middle];
    };
    const OpaqueObjects slice{{{{0.5, 0.5, 0.8}, {0, 0, 1}}}, {}}, surface{{}, {box}};  // at 2.2 and 2.4
    EXPECT_NEAR(farthest(slice, 2.0, 9.0), 2.2, 1e-12);
    EXPECT_NEAR(farthest(slice, 2.2, 9.0), 2.2, 1e-12) << "a slice in the clipping plane shows";
    EXPECT_NEAR(farthest(slice, 0.0, 2.2), 2.2, 1e-12) << "likewise";
    EXPECT_EQ(farthest(slice, 2.3, 9.0), infinite);
    EXPECT_EQ(farthest(slice, 0.0, 2.1), infinite);
    EXPECT_NEAR(farthest(surface, 2.9, 9.0), 2.4, 1e-12);
}

TEST(OpaqueLayer, SurfacesAreLitFromTheSideThatIsSeen) {
    OpaqueSurface box;
    box.mesh = std::make_shared<const mesh::SurfaceMesh>(smallBox());
    box.color = {1, 0.5, 0.25};
    Scene scene = test::sceneOf(test::boxMesh(3, linear), test::constantFunction(0.0));
    const Camera camera = test::cameraAt({0.45, 0.45, 3}, {0.45, 0.45, 0.5}, 9, 9);
    const auto color = [&] {
        PixelMaps maps;
        OpaqueLayer(scene, {{}, {box}}).apply(camera, maps);
        return maps.behind[4 * 9 + 4].x;
    };
    EXPECT_NEAR(color(), 1.0, 1e-6) << "without lights: as by a lamp at the eye";
    scene.settings.shading.ambient = 0.1;
    scene.settings.shading.lights = {{glm::normalize(glm::dvec3(0, 1, 1))}};
    EXPECT_NEAR(color(), 0.1 + std::sqrt(0.5), 1e-6);
    scene.settings.shading.lights = {{glm::dvec3(0, 0, -1)}};
    EXPECT_NEAR(color(), 0.1, 1e-6) << "a light behind does not shine through";
    shading::Light lamp;  // on the way to the eye, 2 away from the surface
    lamp.kind = shading::Light::Kind::Point;
    lamp.position = {0.45, 0.45, 2.6};
    lamp.color = {2, 1, 1};
    lamp.attenuation = {0, 0, 1};
    scene.settings.shading.lights = {lamp};
    EXPECT_NEAR(color(), 0.1 + 2.0 / 4.0, 1e-6);
}

TEST(OpaqueLayer, SmoothNormalsBendFacesNotEdges) {
    // A roof of two faces, 20° or 100° apart along the line x = 0.5.
    const auto brightness = [](double halfAngle, double x) {
        const double drop = 0.3 * std::tan(halfAngle);
        mesh::SurfaceMesh roof;
        roof.positions = {{0.2, 0.2, 0.5 - drop}, {0.5, 0.2, 0.5}, {0.8, 0.2, 0.5 - drop},
                          {0.2, 0.8, 0.5 - drop}, {0.5, 0.8, 0.5}, {0.8, 0.8, 0.5 - drop}};
        roof.triangles = {{0, 1, 4}, {0, 4, 3}, {1, 2, 5}, {4, 1, 5}};  // one of them turned the other way
        OpaqueSurface surface;
        surface.mesh = std::make_shared<const mesh::SurfaceMesh>(roof);
        surface.color = {1, 1, 1};
        Scene scene = test::sceneOf(test::boxMesh(3, linear), test::constantFunction(0.0));
        scene.settings.shading.normals = shading::Normals::Smooth;
        scene.settings.shading.ambient = 0;
        scene.settings.shading.lights = {{glm::dvec3(0, 0, 1)}};
        PixelMaps maps;
        Camera camera = test::cameraAt({x, 0.5, 3}, {x, 0.5, 0.5}, 9, 9);
        OpaqueLayer(scene, {{}, {surface}}).apply(camera, maps);
        return static_cast<double>(maps.behind[4 * 9 + 4].x);
    };
    const double gentle = 10 * std::acos(-1.0) / 180, sharp = 50 * std::acos(-1.0) / 180;
    EXPECT_NEAR(brightness(gentle, 0.499), 1.0, 1e-3) << "the ridge looks up";
    EXPECT_NEAR(brightness(gentle, 0.201), std::cos(gentle), 1e-3) << "far from it the faces are as they are";
    EXPECT_NEAR(brightness(sharp, 0.499), std::cos(sharp), 1e-6) << "an edge stays one";
}

TEST(OpaqueLayer, TheVolumeCastsShadowsOnSurfaces) {
    OpaqueSurface box;
    box.mesh = std::make_shared<const mesh::SurfaceMesh>(smallBox());
    box.color = {1, 1, 1};
    Scene scene = test::sceneOf(test::boxMesh(5, linear), test::constantFunction(1.5));
    scene.settings.shading.ambient = 0;
    scene.settings.shading.lights = {{glm::dvec3(0, 0, 1)}};
    scene.settings.shading.shadows.on = true;
    PixelMaps maps;
    OpaqueLayer(scene, {{}, {box}}).apply(test::cameraAt({0.45, 0.45, 3}, {0.45, 0.45, 0.5}, 9, 9), maps);
    const double thickness = 1 - (3 - maps.farthest[4 * 9 + 4]);  // of the volume above the box
    EXPECT_NEAR(maps.behind[4 * 9 + 4].x, std::exp(-1.5 * thickness), 1e-5);
}

TEST(OpaqueLayer, ASliceBesideTheMeshIsRefused) {
    const Scene scene = test::sceneOf(test::boxMesh(3, linear), test::constantFunction(1.0));
    try {
        OpaqueLayer(scene, {{{{5, 0, 0}, {1, 0, 0}}}, {}});
        FAIL();
    } catch (const std::runtime_error& error) {
        EXPECT_NE(std::string(error.what()).find("5,0,0"), std::string::npos) << error.what();
    }
}

}  // namespace
}  // namespace tetralux::projection
