// SPDX-License-Identifier: Apache-2.0
// Scalars that are exactly a node's: the value from above, in every engine and mode. Labels, constant fields and
// plateaus at a jump, also at the field's largest value; rays along level sets. The pictures are known.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <projection/core/clip_region.h>
#include <tests/stress/engine_cases.h>

namespace tetralux::projection {
namespace {

using namespace tetralux::test;

constexpr Threshold exact{2e-6, 1e-5};  // floats of one segment

const glm::dvec3 below{0.1, 0.2, 0.3}, above{1.0, 0.5, 0.25};

/// Nothing below `value`, extinction 2 from it on, and a jump of the colour there.
preint::TransferFunction jumpAt(double value) {
    preint::TransferFunction f;
    f.color = {{value - 1, below}, {value, below}, {value, above}, {value + 1, above}};
    f.extinction = {{value - 1, 0.0}, {value, 0.0}, {value, 2.0}};
    return f;
}

/// Seen along z, where every ray is 1 long in the unit box.
Camera alongZ(int size = 16) {
    Camera camera = cameraAt({0.5, 0.5, 3}, glm::dvec3(0.5), size, size);
    camera.orthographicHeight = 0.9;
    return camera;
}

Image plain(const Camera& camera, const glm::vec4& color) {
    Image image(camera.width, camera.height);
    for (glm::vec4& pixel : image.pixels) pixel = color;
    return image;
}

/// What a path of 1 through the value from above shows, by mode.
glm::vec4 shown(Mode mode) {
    const double opacity = 1 - std::exp(-2.0);
    switch (mode) {
        case Mode::Standard:
            return glm::vec4(glm::dvec4(above * opacity, opacity));
        case Mode::Absorption:
            return {0, 0, 0, opacity};
        case Mode::Additive:
            return glm::vec4(glm::dvec4(2.0 * above, 1.0));
        case Mode::Emission:
            return glm::vec4(glm::dvec4(2.0 * above, 0.0));
        default:
            return glm::vec4(glm::dvec4(above, 1.0));
    }
}

constexpr Mode modesOfPaths[] = {Mode::Standard, Mode::Absorption, Mode::Additive, Mode::Emission,
                                 Mode::FirstHit, Mode::Mip,        Mode::Minimum,  Mode::Average};

mesh::ScalarMesh constantBox(double value, bool cells) {
    mesh::ScalarMesh m = boxMesh(3, [&](const glm::dvec3&) { return value; });
    if (cells) {
        m.association = mesh::Association::Cell;
        m.scalars.assign(m.cells.size(), value);
    }
    return finished(std::move(m));
}

TEST(StressValues, AConstantFieldAtAJump) {
    for (double value : {1.0, 0.3, -1.0 / 3, 1e9})
        for (bool cells : {false, true})
            for (Mode mode : modesOfPaths)
                holdEnginesTo(plain(alongZ(), shown(mode)), sceneOf(constantBox(value, cells), jumpAt(value), mode),
                              alongZ(), exact, fmt::format("constant {} mode {}", value, static_cast<int>(mode)));
}

TEST(StressValues, LabelsAtAJumpAreFromAboveWhereverItIs) {
    // labels 0, 1, 2 … by layers along x; those from the jump on show, the largest among them
    constexpr int labels = 5;
    mesh::ScalarMesh m = boxMesh(labels + 1, [](const glm::dvec3&) { return 0.0; });
    m.association = mesh::Association::Cell;
    m.scalars.clear();
    for (const auto& cell : m.cells) {
        double x = 0;
        for (auto p : cell) x += 0.25 * m.positions[p].x;
        m.scalars.push_back(std::floor(x * labels) / 3.0);  // no binary fractions
    }
    m = finished(std::move(m));
    for (int jump = 1; jump < labels; ++jump)
        for (Mode mode : modesOfPaths) {
            const Camera camera = alongZ(30);
            Image expected = plain(camera, shown(mode));
            const double opaque = mode == Mode::Mip || mode == Mode::Minimum || mode == Mode::Average;
            for (int y = 0; y < camera.height; ++y)
                for (int x = 0; x < camera.width; ++x)
                    if (0.05 + 0.9 * (x + 0.5) / camera.width < static_cast<double>(jump) / labels)
                        expected.at(x, y) = opaque != 0 ? glm::vec4(glm::dvec4(below, 1)) : glm::vec4(0);
            holdEnginesTo(expected, sceneOf(m, jumpAt(jump / 3.0), mode), camera, exact,
                          fmt::format("label {} of {} mode {}", jump, labels, static_cast<int>(mode)));
        }
}

TEST(StressValues, ThePlateauOnTopOfAField) {
    // s rises to 1 and stays: what is on top is at the jump; nodes may follow it
    const mesh::ScalarMesh m = boxMesh(5, [](const glm::dvec3& p) { return std::min(1.0, 2 * p.x); });
    for (bool nodeAbove : {false, true})
        for (Mode mode : modesOfPaths) {
            preint::TransferFunction f = jumpAt(1.0);
            if (nodeAbove) f.extinction.push_back({2.0, 7.0});
            if (nodeAbove && mode == Mode::Additive) continue;
            Camera camera = alongZ();
            camera.eye.x = camera.target.x = 0.75;
            camera.orthographicHeight = 0.4;
            const Scene scene = sceneOf(m, f, mode);
            holdEnginesTo(plain(camera, shown(mode)), scene, camera, exact,
                          fmt::format("plateau, mode {} {}", static_cast<int>(mode), nodeAbove ? "node above" : ""));
        }
}

TEST(StressValues, CellDataAtAJumpStaysThereWhereItIsCut) {
    const mesh::ScalarMesh m = constantBox(0.3, true);
    const Camera camera = cameraAt({3, 2.6, 2.8}, {0.55, 0.5, 0.5}, 48, 48);
    for (Mode mode : {Mode::Standard, Mode::Additive, Mode::Absorption}) {
        Scene scene = sceneOf(m, jumpAt(0.3), mode);
        scene.mapSources = {
            std::make_shared<ClipRegion>(std::vector<HalfSpace>{{{0.4, 0.4, 0.4}, {-0.3, -0.4, -0.8}}}, 0.0)};
        Scene constant = scene;
        constant.transferFunction = constantFunction(2.0, above);
        const Image expected =
            makeEngine(constant, {.engine = "reference"})->render(camera, *std::make_unique<FrameReport>());
        EXPECT_GT(coveredShare(expected), 0.1);
        holdEnginesTo(expected, scene, camera, {1e-5, 1e-4}, "cell data at a jump, cut");
    }
}

/// s = x in one tetrahedron seen along z: along level sets. The silhouette's limit is τ·|g|·l, with |g| = 1.
TEST(StressValues, SilhouettesAlongLevelSets) {
    const mesh::ScalarMesh m = boxMesh(2, [](const glm::dvec3& p) { return p.x; });
    preint::TransferFunction f;  // several pieces, so that cells hold nodes
    f.color = {{0.0, above}, {1.0, above}};
    f.extinction = {{0.0, 0.1}, {0.3, 0.4}, {0.6, 0.2}, {1.0, 0.7}};
    for (Mode mode : {Mode::ScaleInvariant, Mode::DataAdditive})
        for (bool approximate : {false, true}) {
            Scene scene = sceneOf(m, f, mode);
            scene.settings.shading.silhouette = true;
            scene.settings.shading.approximateSilhouette = approximate;
            const Camera camera = alongZ();
            Image expected(camera.width, camera.height);
            for (int y = 0; y < camera.height; ++y)
                for (int x = 0; x < camera.width; ++x) {
                    const double tau = f.extinctionAt(0.05 + 0.9 * (x + 0.5) / camera.width);
                    // the box is cut into cells along the ray: opacities of the approximation do not compose, so that
                    // only its first order is known
                    const double opacity = mode == Mode::DataAdditive ? tau : 1 - std::exp(-tau);
                    expected.at(x, y) = glm::vec4(glm::dvec4(above * opacity, std::min(opacity, 1.0)));
                }
            if (approximate && mode == Mode::ScaleInvariant) {
                holdEnginesTo(referenceImage(scene, camera), scene, camera, {1e-4, 3e-4}, "approximate silhouettes");
                EXPECT_GT(coveredShare(referenceImage(scene, camera)), 0.99);
                continue;
            }
            holdEnginesTo(expected, scene, camera, {1e-4, 3e-4}, "silhouettes along level sets");
        }
}

TEST(StressValues, AnApproximateSilhouetteAlongALevelSet) {
    Scene scene = sceneOf(unitTetrahedron({0, 1, 0, 0}), constantFunction(1.0), Mode::ScaleInvariant);
    scene.settings.shading.silhouette = scene.settings.shading.approximateSilhouette = true;
    Camera camera = cameraAt({0.3, 0.3, 3}, {0.3, 0.3, 0}, 1, 1);
    camera.orthographicHeight = 1e-3;
    const float length = 0.4f;  // from z = 0 to x + y + z = 1
    holdEnginesTo(plain(camera, glm::vec4(glm::vec3(0.8f, 0.5f, 0.25f) * length, length)), scene, camera, exact,
                  "min(1, τ·|g|·l)");
}

}  // namespace
}  // namespace tetralux::projection
