// SPDX-License-Identifier: Apache-2.0
// Numbers at the edge of what float and double hold. In each case the answer is known: the same scene in benign units,
// or a closed form.
#include <numbers>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <tests/stress/engine_cases.h>

namespace tetralux::projection {
namespace {

using namespace tetralux::test;

// The fast engines sample 1e-4 pixel beside the centre and hold lengths and scalars in float: 1e-5 of the contrast
// inside, more in the few pixels that an outline crosses. Tables are built for 1e-4.
constexpr Threshold benign{1e-4, 3e-3};

double wave(const glm::dvec3& p) {
    return 0.5 + 0.5 * std::sin(4 * p.x + 2 * p.y) * std::cos(3 * p.z);
}

const glm::dvec3 eye{1.9, 1.4, 2.3};

struct UnitsCase {
    std::string name;
    double scale, shift;  // positions become scale·(p + shift)
};

void PrintTo(const UnitsCase& units, std::ostream* out) {
    *out << units.name;
}

class MeshUnits : public ::testing::TestWithParam<UnitsCase> {};

TEST_P(MeshUnits, DoNotChangeThePicture) {
    const auto [name, scale, shift] = GetParam();
    const mesh::ScalarMesh base = jitteredBoxMesh(6, 0.2, 4, wave);
    const glm::dvec3 offset = shift * glm::dvec3(1, -0.6, 0.3);
    mesh::ScalarMesh moved = base;
    for (auto& p : moved.positions) p = scale * (p + offset);
    moved = finished(std::move(moved));
    const Camera camera = cameraAt(eye),
                 movedCamera = cameraAt(scale * (eye + offset), scale * (glm::dvec3(0.5) + offset));
    for (Mode mode : {Mode::Standard, Mode::ScaleInvariant}) {
        preint::TransferFunction f = smoothFunction(0, 1, 10), scaled = f;
        if (mode == Mode::Standard)
            for (auto& node : scaled.extinction) node.extinction /= scale;
        const Image expected = referenceImage(sceneOf(base, f, mode), camera);
        EXPECT_GT(coveredShare(expected), 0.2);
        holdEnginesTo(expected, sceneOf(moved, scaled, mode), movedCamera, benign,
                      fmt::format("{} {}", name, mode == Mode::Standard ? "standard" : "scale-invariant"));
    }
}

INSTANTIATE_TEST_SUITE_P(Stress, MeshUnits,
                         ::testing::Values(UnitsCase{"size 1e-15", 1e-15, 0}, UnitsCase{"size 1e-12", 1e-12, 0},
                                           UnitsCase{"size 1e12", 1e12, 0}, UnitsCase{"size 1e15", 1e15, 0},
                                           UnitsCase{"shifted by 1e6 boxes", 1, 1e6},
                                           UnitsCase{"shifted by 1e7, size 1e-3", 1e-3, 1e7}),
                         [](const auto& testCase) {
                             std::string name = testCase.param.name;
                             for (char& c : name)
                                 if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
                             return name;
                         });

TEST(StressScalars, MagnitudeAndOffsetDoNotChangeThePicture) {
    const mesh::ScalarMesh base = jitteredBoxMesh(6, 0.2, 4, wave);
    const Camera camera = cameraAt(eye);
    for (const auto& [scale, offset] : {std::pair{1e30, 0.0}, {1e-30, 0.0}, {1e-300, 0.0}, {1e-310, 0.0}, {1.0, 1e6}})
        for (Mode mode : {Mode::Standard, Mode::ScaleInvariant}) {
            if (mode == Mode::ScaleInvariant && scale < 1e-307) continue;  // its extinction would be infinite
            mesh::ScalarMesh m = base;
            for (double& s : m.scalars) s = scale * (s + offset);
            m = finished(std::move(m));
            preint::TransferFunction f = smoothFunction(0, 1, 10), moved = f;
            for (auto& node : moved.color) node.scalar = scale * (node.scalar + offset);
            for (auto& node : moved.extinction) {
                node.scalar = scale * (node.scalar + offset);
                if (mode == Mode::ScaleInvariant) node.extinction /= scale;
            }
            holdEnginesTo(referenceImage(sceneOf(base, f, mode), camera), sceneOf(m, moved, mode), camera, benign,
                          fmt::format("scalars x {:g} + {:g} {}", scale, offset,
                                      mode == Mode::Standard ? "standard" : "scale-invariant"));
        }
}

TEST(StressOpacity, OpticalDepthsOfTwentyFourDecades) {
    // a ramp, so that nothing is constant: τ·l of the whole box from 1e-12 to 1e12
    const mesh::ScalarMesh m = boxMesh(5, [](const glm::dvec3& p) { return 0.2 + 0.6 * p.x; });
    for (Mode mode : {Mode::Standard, Mode::ScaleInvariant})
        for (int exponent = -12; exponent <= 12; exponent += 4) {
            const double strongest = std::pow(10.0, exponent);
            const Scene scene = sceneOf(m, smoothFunction(0, 1, strongest), mode);
            const Image expected = referenceImage(scene, cameraAt(eye));
            // opacity is 1 − transmittance in float, which holds 6e-8 at best; what is more is relative to what there
            // is
            const double scale = std::min(1.0, strongest);
            holdEnginesTo(expected, scene, cameraAt(eye), {1e-7 + 1e-5 * scale, 1e-6 + 1e-4 * scale},
                          fmt::format("optical depth 1e{} {}", exponent,
                                      mode == Mode::Standard ? "standard" : "scale-invariant"));
        }
}

TEST(StressOpacity, RampsFromNothingToTwelveDecades) {
    // at the foot of the ramp a scalar's rounding is much of what there is, and tables have a texel for all of it;
    // isosurfaces stay free: single pixels on an outline. A wave shows the foot in front of everything else
    const mesh::ScalarMesh m = jitteredBoxMesh(9, 0.2, 4, [](const glm::dvec3& p) { return std::pow(wave(p), 8.0); });
    struct Case {
        Mode mode;
        double foot, strongest;
        bool silhouettes;
    };
    for (const Case& ramp : {Case{Mode::Standard, 0, 1e4, false}, Case{Mode::Standard, 0, 1e5, true},
                             Case{Mode::Standard, 0.3, 1e6, false}, Case{Mode::Standard, 0, 1e12, true},
                             Case{Mode::ScaleInvariant, 0, 1e6, false}, Case{Mode::ScaleInvariant, 0.3, 1e8, true}}) {
        preint::TransferFunction f = smoothFunction(0, 1, 1);
        f.extinction = {{ramp.foot, 0}, {1, ramp.strongest}};
        Scene scene = sceneOf(m, f, ramp.mode);
        scene.settings.shading.silhouette = ramp.silhouettes;
        const Image expected = referenceImage(scene, cameraAt(eye));
        EXPECT_GT(coveredShare(expected), 0.1);
        holdEnginesTo(expected, scene, cameraAt(eye), {1e-4, 1.0},
                      fmt::format("ramp from {} to {:g} {}{}", ramp.foot, ramp.strongest,
                                  ramp.mode == Mode::Standard ? "standard" : "scale-invariant",
                                  ramp.silhouettes ? ", silhouettes" : ""));
    }
}

TEST(StressScalars, AConstantFieldHasItsClosedForm) {
    for (double value : {0.0, -7e29, 1e-320})
        for (double extinction : {1e-12, 1.0, 1e12}) {
            const Scene scene = sceneOf(boxMesh(4, [=](auto&) { return value; }), constantFunction(extinction));
            const Camera camera = cameraAt(eye);
            const CameraFrame frame = cameraFrame(camera);
            Image expected(camera.width, camera.height);
            for (int y = 0; y < camera.height; ++y)
                for (int x = 0; x < camera.width; ++x) {
                    const auto [in, out] = pathInBox(pixelRay(frame, x, y), glm::dvec3(0), glm::dvec3(1));
                    const double alpha = out > in ? -std::expm1(-extinction * (out - in)) : 0.0;
                    expected.at(x, y) = glm::vec4(glm::dvec4(scene.transferFunction.color[0].color * alpha, alpha));
                }
            // at 1e12 even a path of 1e-12 shows: a pixel whose centre an outline touches may go either way, but none
            // lies there here
            holdEnginesTo(expected, scene, camera, benign,
                          fmt::format("constant field {:g}, extinction {:g}", value, extinction));
        }
}

TEST(StressDepth, TenThousandThinCells) {
    // 2,000 slabs of 5 cells along the view; τ so small that each cell's opacity is 1e-4 and less
    const int slabs = 2000;
    mesh::ScalarMesh m = boxMesh(2, [](const glm::dvec3& p) { return p.z; });
    const mesh::ScalarMesh one = m;
    m.positions.clear();
    m.cells.clear();
    m.scalars.clear();
    for (int k = 0; k < slabs; ++k) {
        const auto first = static_cast<mesh::PointIndex>(m.positions.size());
        for (const auto& p : one.positions) {
            // every second slab mirrored, so that the diagonals of touching faces agree in place
            m.positions.push_back({k % 2 ? 1 - p.x : p.x, p.y, (k + p.z) / slabs});
            m.scalars.push_back(m.positions.back().z);
        }
        for (auto cell : one.cells) {
            if (k % 2) std::swap(cell[2], cell[3]);
            m.cells.push_back({cell[0] + first, cell[1] + first, cell[2] + first, cell[3] + first});
        }
    }
    m = finished(std::move(m));
    const Scene scene = sceneOf(m, constantFunction(1));
    const Camera camera = cameraAt({0.5, 0.5, 3}, glm::dvec3(0.5), 24, 24);
    const CameraFrame frame = cameraFrame(camera);
    Image expected(24, 24);
    for (int y = 0; y < 24; ++y)
        for (int x = 0; x < 24; ++x) {
            const auto [in, out] = pathInBox(pixelRay(frame, x, y), glm::dvec3(0), glm::dvec3(1));
            const double alpha = out > in ? -std::expm1(-(out - in)) : 0.0;
            expected.at(x, y) = glm::vec4(glm::dvec4(scene.transferFunction.color[0].color * alpha, alpha));
        }
    holdEnginesTo(expected, scene, camera, benign, "10,000 cells along the view");
}

TEST(StressViews, AnyAngleAndPlaceOfTheEye) {
    const mesh::ScalarMesh m = boxMesh(5, wave);
    const Scene scene = sceneOf(m, smoothFunction(0, 1, 6));
    struct View {
        const char* name;
        Camera camera;
    };
    std::vector<View> views;
    auto add = [&](const char* name, const glm::dvec3& from, const glm::dvec3& to, double fov, double height = 0) {
        Camera camera = cameraAt(from, to, 33, 33);  // odd: the central ray is exactly the axis
        camera.fovDegrees = fov;
        camera.orthographicHeight = height;
        if (std::abs(glm::normalize(to - from).y) > 0.99) camera.up = {0, 0, 1};
        views.push_back({name, camera});
    };
    const glm::dvec3 centre(0.5);
    add("fov 0.01 degrees", centre + 6000.0 * glm::normalize(glm::dvec3(1, 0.7, 1.2)), centre, 0.01);
    add("fov 170 degrees, inside", {0.4, 0.45, 0.55}, {1, 0.5, 0.5}, 170);
    add("along x", {3, 0.5, 0.5}, centre, 30);
    add("along y", {0.5, 3, 0.5}, centre, 30);
    add("along z, orthographic", {0.5, 0.5, 3}, centre, 30, 1.2);
    add("along the diagonal, orthographic", {3, 3, 3}, centre, 30, 1.8);
    add("eye on an inner vertex", {0.25, 0.5, 0.5}, {1, 0.5, 0.5}, 60);
    add("eye on an inner edge", {0.3, 0.5, 0.5}, {1, 0.6, 0.5}, 60);
    add("eye on an inner face", {0.3, 0.55, 0.5}, {1, 0.6, 0.6}, 60);
    add("eye on a corner of the boundary", {0, 0, 0}, centre, 60);
    add("eye on the boundary", {0.5, 0.5, 1}, centre, 60);
    add("orthographic plane inside", {0.5, 0.5, 0.6}, {0.5, 0.4, 0}, 30, 1.2);
    for (const View& view : views) {
        const Image expected = referenceImage(scene, view.camera);
        EXPECT_GT(coveredShare(expected), 0.1) << view.name;
        // degenerate rays lie in faces: a pixel at the rim may belong to the box or not, one of 33² is 3e-2 of rmse
        holdEnginesTo(expected, scene, view.camera, {2e-4, 5e-3}, view.name);
    }
}

TEST(StressOpacity, OpaqueIsosurfacesAndStrongExtinction) {
    const mesh::ScalarMesh m = jitteredBoxMesh(6, 0.2, 4, [](const glm::dvec3& p) { return p.x + 0.3 * p.y; });
    preint::TransferFunction isosurfaces = isosurfacesFunction(0, 1.3);
    isosurfaces.isosurfaces[0].opacity = 1;
    preint::TransferFunction wall = smoothFunction(0, 1.3, 1e6);
    for (Mode mode : {Mode::Standard, Mode::ScaleInvariant})
        for (const auto& [name, f] : {std::pair{"opaque isosurface", isosurfaces}, {"extinction up to 1e6", wall}}) {
            const Scene scene = sceneOf(m, f, mode);
            // edges of the isosurface and of the wall may fall into the neighbouring pixel
            holdEnginesTo(referenceImage(scene, cameraAt(eye)), scene, cameraAt(eye), {2e-3, 0.5}, name);
        }
}

TEST(StressShading, GrazingRaysKeepSilhouettesFinite) {
    preint::TransferFunction f = smoothFunction(0, 1, 4);
    f.isosurfaces = {{0.5, 0.5, {1, 1, 1}}};
    for (Mode mode : {Mode::Standard, Mode::ScaleInvariant}) {
        Scene scene = sceneOf(boxMesh(5, [](const glm::dvec3& p) { return p.y; }), f, mode);
        scene.settings.shading.silhouette = true;
        scene.settings.shading.lights = {{{0, 0, 1}}};
        const Camera camera =
            cameraAt({0.5, 0.5, 3}, glm::dvec3(0.5), 33, 33);  // the middle row runs along the isosurface
        // k has a pole at grazing rays: 1e-4 pixel beside it the opacity of an isosurface is another one
        holdEnginesTo(referenceImage(scene, camera), scene, camera, {3e-2, 1.0}, "grazing rays");
    }
}

}  // namespace
}  // namespace tetralux::projection
