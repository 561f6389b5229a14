// SPDX-License-Identifier: Apache-2.0
//
// Locally adaptive opacity: closed forms on boxes, independence of the mesh's resolution, engines against each other.
#include <gtest/gtest.h>

#include <mesh/io/read_mesh.h>
#include <projection/frame/adaptive_opacity.h>
#include <projection/frame/amount_map.h>
#include <tests/support/analytic_scenes.h>
#include <tests/support/engine_pictures.h>

namespace tetralux::projection {
namespace {

using namespace tetralux::test;
using Amount = AdaptiveSettings::Amount;
using Filter = AdaptiveSettings::Filter;

const EngineOptions reference{"reference", "auto"};

Scene boxScene(int n, Mode mode, const AdaptiveSettings& adaptive) {
    Scene scene = sceneOf(boxMesh(n, [](const glm::dvec3& p) { return p.x; }), constantFunction(1.7), mode);
    scene.settings.adaptive = adaptive;
    return scene;
}

AdaptiveSettings unfiltered(Amount amount, double most) {
    AdaptiveSettings settings;
    settings.amount = amount;
    settings.filter = Filter::None;
    settings.most = most;
    return settings;
}

// Extinction 1/X all along X: depth 1 wherever the bound does not act, gain or not; below it depth = bound·X.
TEST(AdaptiveOpacity, DepthIsOneWhateverTheLength) {
    const double most = 2.5;
    const Scene scene = boxScene(3, Mode::Standard, unfiltered(Amount::Length, most));
    const Camera camera = cameraAt({1.9, 1.4, 2.3});
    const CameraFrame frame = cameraFrame(camera);
    for (const std::string engine : {"reference", "cpu", "gl"}) {
        const Image image = pictureOf(scene, camera, {engine, "auto"});
        int bounded = 0, free = 0;
        for (int y = 0; y < camera.height; ++y)
            for (int x = 0; x < camera.width; ++x) {
                const auto [in, out] = pathInBox(pixelRay(frame, x, y), glm::dvec3(0), glm::dvec3(1));
                if (out <= in) continue;
                const double amount = (out - in) / std::sqrt(3.0);
                const double depth = std::min(1.0, most * amount);
                depth < 1 ? ++bounded : ++free;
                ASSERT_NEAR(image.at(x, y).w, -std::expm1(-depth), 1e-4) << engine << ' ' << x << ' ' << y;
            }
        EXPECT_GT(bounded, 20);
        EXPECT_GT(free, 100);
    }
}

// Nothing hidden: Σ c τ₀ l = c, the mean colour.
TEST(AdaptiveOpacity, AdditiveIsAMean) {
    const Scene scene = boxScene(3, Mode::Additive, unfiltered(Amount::Length, 1e3));
    const Camera camera = cameraAt({1.9, 1.4, 2.3});
    const Image image = pictureOf(scene, camera, {"cpu", "auto"});
    EXPECT_NEAR(image.at(24, 20).x, 0.8, 1e-4);
    EXPECT_NEAR(image.at(24, 20).y, 0.5, 1e-4);
    EXPECT_NEAR(image.at(24, 20).w, 1.0, 1e-4);
}

TEST(AdaptiveOpacity, CellsAreThePapersCount) {
    const int n = 5;
    Scene scene = boxScene(n, Mode::Standard, unfiltered(Amount::Cells, 0.2));
    const Camera camera = cameraAt({1.9, 1.4, 2.3});
    const Image image = pictureOf(scene, camera, reference);
    const CameraFrame frame = cameraFrame(camera);
    const double h = std::cbrt(1.0 / (5.0 * (n - 1) * (n - 1) * (n - 1)));
    const ReferenceRayCaster caster(scene);
    for (int y = 0; y < camera.height; y += 3)
        for (int x = 0; x < camera.width; x += 3) {
            const auto count = static_cast<double>(caster.segmentsAt(camera, x, y).size());
            const auto [in, out] = pathInBox(pixelRay(frame, x, y), glm::dvec3(0), glm::dvec3(1));
            if (out <= in || count == 0) continue;
            const double opacityOfCell = std::min(1.0 / count, 0.2);
            ASSERT_NEAR(image.at(x, y).w, -std::expm1(-opacityOfCell * (out - in) / h), 1e-4);
        }
}

// Twice as fine a mesh: the relevant length is the same, the number of cells is not.
TEST(AdaptiveOpacity, LengthDoesNotDependOnTheMesh) {
    const Camera camera = cameraAt({1.9, 1.4, 2.3});
    const auto difference = [&](Amount amount, double most) {
        const AdaptiveSettings settings = unfiltered(amount, most);
        const Scene coarse = boxScene(5, Mode::Standard, settings), fine = boxScene(9, Mode::Standard, settings);
        return compareImages(pictureOf(coarse, camera, {"cpu", "auto"}), pictureOf(fine, camera, {"cpu", "auto"})).max;
    };
    EXPECT_LE(difference(Amount::Length, 10.0), 1e-4);
    EXPECT_GT(difference(Amount::Cells, 10.0), 1e-2);
}

TEST(AdaptiveOpacity, RelevanceIsOneFromTheThresholdOn) {
    preint::TransferFunction function = smoothFunction(0, 1, 10.0);  // τ: 0, 0.8, 2, 5, 10
    function.isosurfaces = {{0.1, 0.5, {1, 1, 1}}};
    const auto relevance = relevanceOf(function, 0.2, 3.0);
    for (double s : {0.0, 0.3, 0.499}) EXPECT_EQ(relevance.extinctionAt(s), 0.0) << s;
    for (double s : {0.501, 0.7, 1.0, 2.0}) EXPECT_EQ(relevance.extinctionAt(s), 3.0) << s;
    EXPECT_EQ(relevance.isosurfaces.size(), 1u);
    // threshold 0: wherever there is extinction at all
    EXPECT_EQ(relevanceOf(function, 0.0, 1.0).extinctionAt(0.01), 1.0);
    function.extinction = {{0.2, 0.0}, {0.2, 4.0}, {0.4, 4.0}, {0.4, 0.0}};
    const auto box = relevanceOf(function, 0.5, 1.0);
    EXPECT_EQ(box.extinctionAt(0.19), 0.0);
    EXPECT_EQ(box.extinctionAt(0.3), 1.0);
    EXPECT_EQ(box.extinctionAt(0.41), 0.0);
    EXPECT_EQ(relevanceOf(constantFunction(2.0), 0.5, 1.0).extinctionAt(7.0), 1.0);
}

class Filters : public testing::TestWithParam<Filter> {};

// A constant stays what it is, nothing stays nothing, and what lies beside nothing is not thinned.
TEST_P(Filters, AreMeansOfWhatIsThere) {
    AdaptiveSettings settings;
    settings.filter = GetParam();
    const Camera camera = cameraAt({0, 0, 3}, glm::dvec3(0), 37, 26);
    const auto half = [](const View& view) {
        Image image(view.camera.width, view.camera.height);
        for (int y = 0; y < image.height; ++y)
            for (int x = 0; x < image.width / 2; ++x) image.at(x, y) = glm::vec4(0, 5, 0, 0);
        return image;
    };
    const std::vector<float> map = amountMap(camera, settings, 1, half);
    ASSERT_EQ(map.size(), 37u * 26u);
    for (int y = 0; y < 26; ++y) {
        for (int x = 0; x < 16; ++x) EXPECT_NEAR(map[static_cast<std::size_t>(y * 37 + x)], 5.0f, 1e-5f);
        EXPECT_EQ(map[static_cast<std::size_t>(y * 37 + 36)], 0.0f);
    }
}

// What is linear across the picture is found again by interpolation (away from the rims, where it ends).
TEST_P(Filters, KeepWhatIsLinear) {
    AdaptiveSettings settings;
    settings.filter = GetParam();
    settings.sigma = 1.5;
    const Camera camera = cameraAt({0, 0, 3}, glm::dvec3(0), 45, 41);
    const auto slope = [&](const View& view) {
        Image image(view.camera.width, view.camera.height);
        for (int y = 0; y < image.height; ++y)
            for (int x = 0; x < image.width; ++x) {
                const CameraFrame frame = cameraFrame(view.camera);
                const glm::dvec3 d = pixelRay(frame, x, y).direction;
                image.at(x, y).x = static_cast<float>(10 + 9 * d.x / d.z);
            }
        return image;
    };
    const std::vector<float> map = amountMap(camera, settings, 0, slope);
    const Image exact = slope(camera);
    for (int y = 8; y < 33; ++y)
        for (int x = 8; x < 37; ++x)
            EXPECT_NEAR(map[static_cast<std::size_t>(y * 45 + x)], exact.at(x, y).x, 1e-4f) << x << ' ' << y;
}

INSTANTIATE_TEST_SUITE_P(All, Filters,
                         testing::Values(Filter::None, Filter::Gaussian, Filter::Bilinear2, Filter::Bilinear4));

TEST(AdaptiveOpacity, EnginesAgree) {
    auto read = mesh::readMesh("bucky:12");
    auto selected = mesh::selectScalar(std::move(read.mesh), "", read.report);
    for (const Mode mode : {Mode::Standard, Mode::ScaleInvariant, Mode::Additive})
        for (const Amount amount : {Amount::Cells, Amount::Length}) {
            Scene scene = sceneOf(selected.mesh, smoothFunction(0, 1, 10.0), mode);
            scene.settings.adaptive = AdaptiveSettings{};
            scene.settings.adaptive->amount = amount;
            if (amount == Amount::Cells) scene.settings.adaptive->most = 0.1;
            scene.settings.adaptive->gain = 2.0;
            Camera camera = cameraAt({0, 0, 0}, glm::dvec3(0.5), 60, 48);
            camera.eye = threeQuarterEye(scene.mesh->bounds, camera);
            // the count of cells at a rim may differ by one, which the filter spreads
            expectEnginesAgree(scene, camera, {1e-3, 2e-2}, "adaptive");
        }
}

}  // namespace
}  // namespace tetralux::projection
