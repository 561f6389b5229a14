// SPDX-License-Identifier: Apache-2.0
//
// Compute tiles (gl_tiles.h) against the rasterizer, which draws the same cells by the same text of pixels, and against
// the reference. Here both run on llvmpipe.
#include <projection/gl/gl_tiles.h>

#include <functional>
#include <numeric>
#include <stdexcept>

#include <glm/geometric.hpp>

#include <projection/gl/gl_draw_trial.h>
#include <projection/gl/gl_frame_target.h>
#include <projection/gl/gl_path.h>
#include <projection/gl/gl_resident_cells.h>
#include <projection/opaque/opaque_layer.h>
#include <tests/support/engine_pictures.h>
#include <tests/support/gl_path_pictures.h>

namespace tetralux::projection {
namespace {

using namespace tetralux::test;

EngineOptions tileOptions(const std::string& context) {
    EngineOptions options;
    options.engine = "gl";
    options.context = context;
    options.glPath = "tiles";
    return options;
}

class TileModes : public testing::TestWithParam<Mode> {};

TEST_P(TileModes, LikeStream) {
    Scene scene = sceneOf(jitteredBoxMesh(7, 0.2, 5, waves), smoothFunction(0.1, 0.9), GetParam());
    scene.settings.earlyTermination = false;
    expectSame(scene, views(), "tiles");
}

INSTANTIATE_TEST_SUITE_P(All, TileModes, testing::ValuesIn(pathModes));

TEST(Tiles, SilhouettesAndLights) {
    expectSame(litScene(7, false), {views()[0]}, "tiles", "auto");
    expectSame(litScene(7, true), views(), "tiles", "auto");
}

class TileIntegrals : public testing::TestWithParam<Mode> {};

// The thresholds of gl_engine_test.cpp: what a table of the default error and float leave; the rim of an isosurface may
// fall into a neighbouring pixel.
TEST_P(TileIntegrals, LikeReference) {
    const mesh::ScalarMesh m = jitteredBoxMesh(8, 0.2, 5, waves);
    struct Case {
        const char* what;
        preint::TransferFunction function;
        EngineThreshold threshold;
    };
    const Case cases[] = {{"smooth", smoothFunction(0.1, 0.9), {2e-5, 4e-4}},
                          {"isosurfaces", isosurfacesFunction(0.1, 0.9), {2e-4, 2e-2}},
                          {"opaque", smoothFunction(0.1, 0.9, 400.0), {2e-5, 4e-4}},
                          {"constant", constantFunction(3.0), {5e-6, 1e-4}}};
    const std::vector<View> outsideAndInside{views()[0], views()[1]};
    for (const auto& [what, function, threshold] : cases) {
        const Scene scene = sceneOf(m, function, GetParam());
        for (const View& view : outsideAndInside) {
            const Image reference = referenceThatShows(scene, view, what);
            for (const char* context : {"egl", "osmesa"})
                expectLike(reference, scene, view, tileOptions(context), threshold, what);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Both, TileIntegrals, testing::Values(Mode::Standard, Mode::ScaleInvariant));

TEST(Tiles, ASliceWithinTheVolume) {
    Scene scene = sceneOf(jitteredBoxMesh(7, 0.2, 5, waves), smoothFunction(0.1, 0.9));
    scene.mapSources.push_back(
        std::make_shared<const OpaqueLayer>(scene, OpaqueObjects{{{{0.5, 0.5, 0.5}, {0.2, -0.1, 1}}}, {}}));
    const Image reference = referenceThatShows(scene, views()[0]);
    for (const char* context : {"egl", "osmesa"})
        expectLike(reference, scene, views()[0], tileOptions(context), {5e-5, 1e-3}, "slice");
}

// What is wrong with a view is no fault of the path.
TEST(Tiles, AViewThatIsRefusedLeavesThePath) {
    const Scene scene = sceneOf(boxMesh(4, waves), smoothFunction(0.1, 0.9));
    const auto engine = engineOf(scene, "tiles");
    const Camera camera = views()[0].camera;
    PixelMaps tooStrong;
    tooStrong.extinctionScale.assign(static_cast<std::size_t>(camera.width * camera.height), 2.0f);
    EXPECT_THROW(pictureOf(*engine, {camera, &tooStrong}), std::runtime_error);
    Camera tooLarge = camera;
    tooLarge.width = 1 << 20;
    EXPECT_THROW(pictureOf(*engine, tooLarge), std::runtime_error);
    EXPECT_EQ(pictureOf(*engine, camera).report.dataPath, "tiles");
}

TEST(Tiles, OpaqueTilesEndEarly) {
    Scene scene = sceneOf(jitteredBoxMesh(13, 0.2, 5, waves), smoothFunction(0.1, 0.9, 4000.0));
    scene.settings.table.size = 32;
    Camera camera = views()[0].camera;
    camera.width = camera.height = 64;
    camera.fovDegrees = 15;  // nothing but the volume
    const PathPicture early = pictureOf(*engineOf(scene, "tiles"), camera);
    scene.settings.earlyTermination = false;
    const PathPicture whole = pictureOf(*engineOf(scene, "tiles"), camera);
    EXPECT_LE(compareImages(early.image, whole.image).max, 2e-6);  // leastTransmittance, and float
    EXPECT_EQ(early.report.tilesRetired, 16u);
    EXPECT_EQ(whole.report.tilesRetired, 0u);
    EXPECT_LT(2 * early.report.fragments, whole.report.fragments);
    EXPECT_GT(early.report.tileEntriesSaved, early.report.tileEntries / 4);
    EXPECT_EQ(whole.report.tileEntriesSaved, 0u);
}

TEST(Tiles, EmptyViewAndOneCell) {
    const Scene box = sceneOf(boxMesh(4, waves), smoothFunction(0.1, 0.9));
    for (const char* context : {"egl", "osmesa"}) {
        const auto engine = engineOf(box, "tiles", context);
        Camera away = views()[0].camera;
        away.target = away.eye + (away.eye - away.target);
        const PathPicture nothing = pictureOf(*engine, away);
        EXPECT_EQ(nothing.report.cellsDrawn, 0u);
        EXPECT_EQ(nothing.report.dataPath, "tiles");
        for (const glm::vec4& pixel : nothing.image.pixels) ASSERT_EQ(pixel, glm::vec4(0));
        EXPECT_GT(pictureOf(*engine, views()[0]).report.fragments, 0u);  // and something again

        const Scene one = sceneOf(unitTetrahedron({0.0, 1.0, 0.3, 0.7}), smoothFunction(0.0, 1.0));
        expectSame(one, {cameraAt({2, 1.7, 1.9}, glm::dvec3(0.2)), cameraAt(glm::dvec3(0.1), {0.3, 0.5, 0.2})}, "tiles",
                   context);
    }
}

TEST(Tiles, OrderOfTheGraph) {
    const auto hollow = [](const glm::dvec3& p) { return glm::length(p - glm::dvec3(0.5)) > 0.3; };
    const Scene scene = sceneOf(carved(jitteredBoxMesh(8, 0.2, 5, waves), hollow), smoothFunction(0.1, 0.9));
    expectSame(scene, {views()[0], views()[1]}, "tiles", "auto");
}

// Thousands of cells of one key, more than one lane of the GPU settles, send the frame to the processor.
TEST(Tiles, TooManyEqualKeysGoToTheProcessor) {
    const auto [scene, camera] = clumpOfCells(9, 1e-9);
    const PathPicture stream = pictureOf(*engineOf(scene, "stream"), camera);
    const PathPicture tiles = pictureOf(*engineOf(scene, "tiles"), camera);
    EXPECT_GT(stream.report.cellsDrawn, 1000u);
    EXPECT_LE(compareImages(stream.image, tiles.image).max, 0.0);
    EXPECT_EQ(tiles.report.dataPath, "stream");
    EXPECT_EQ(tiles.report.dataPathReason, "the GPU could not put all cells in order");
}

/// The two lowest levels of the path, with a program of tiles made by the engine's own means.
class TileParts : public testing::TestWithParam<std::string> {
protected:
    TileParts() : context(makeGlContext(GetParam())), current(*context), gl(loadGlFunctions(*context)) {}
    std::unique_ptr<GlContext> context;
    CurrentGlContext current;
    std::unique_ptr<GlFunctions> gl;
};

// One cell before the eye covers all 4,096 tiles: four pairs a cell and 1,024 were room for a quarter of them.
TEST(Tiles, PairsThatDoNotFitGrow) {
    const Scene scene = sceneOf(unitTetrahedron({0.0, 1.0, 0.3, 0.7}), smoothFunction(0.0, 1.0, 2.0));
    Camera camera = cameraAt(glm::dvec3(0.1), {0.3, 0.5, 0.2}, 1024, 1024);
    for (const char* context : {"egl", "osmesa"}) {
        const auto tiles = engineOf(scene, "tiles", context);
        const PathPicture grown = pictureOf(*tiles, camera), again = pictureOf(*tiles, camera);
        const PathPicture stream = pictureOf(*engineOf(scene, "stream", context), camera);
        EXPECT_EQ(grown.report.dataPath, "tiles");
        EXPECT_EQ(grown.report.tileEntries, 4096u);
        EXPECT_EQ(grown.report.fragments, 1024u * 1024u);
        EXPECT_LE(compareImages(grown.image, stream.image).max, roundingOnly);
        EXPECT_EQ(compareImages(grown.image, again.image).max, 0.0);
    }
}

TEST_P(TileParts, RoomGrowsByWhatWasMissing) {
    const mesh::ScalarMesh m = jitteredBoxMesh(7, 0.2, 5, waves);
    std::vector<mesh::CellIndex> all(m.cells.size());
    std::iota(all.begin(), all.end(), mesh::CellIndex{0});
    const std::size_t chunk = 300;  // several chunks, the last of them not full
    GlResidentCells cells(*gl, m, sceneUnits(m), all, nullptr, nullptr, {}, {}, chunk);
    ASSERT_GT(all.size(), 3 * chunk);
    ASSERT_EQ(cells.chunkCells(), chunk);
    GlTiles tiles(*gl, {}, chunk, 8);
    const CameraFrame frame = cameraFrame(views()[0].camera);
    GlFrameTarget target(*gl);
    for (int run = 0; run < 3; ++run) {
        target.begin(frame.width, frame.height, 0.0f);
        cells.drawTiles(frame, nullptr, 0.01, tiles, target.texture(), [] {});
        const std::size_t before = tiles.capacity();
        EXPECT_EQ(tiles.overflowed(), run == 0);
        EXPECT_EQ(tiles.capacity() > before, run == 0);
    }
    EXPECT_GT(tiles.capacity(), chunk);
    EXPECT_LT(tiles.capacity(), 20 * chunk);
}

// A driver that takes no compute shader: what it says is the reason for another path.
TEST_P(TileParts, ARefusedShaderIsOneLine) {
    GlFunctions refusing = *gl;
    refusing.CompileShader = [](GLuint) {};  // never compiled
    for (const auto& make : {std::function<void()>([&] { GlTiles(refusing, {}, 100, 100); }),
                             std::function<void()>([&] { GlRadixSort(refusing, 100); })}) {
        try {
            make();
            FAIL() << "was taken";
        } catch (const std::runtime_error& error) {
            const std::string text = error.what();
            EXPECT_NE(text.find("the driver rejects it"), std::string::npos) << text;
            EXPECT_EQ(text.find('\n'), std::string::npos) << text;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Contexts, TileParts, testing::Values("egl", "osmesa"));

TEST(GlPath, TheRuleOfTiles) {
    const std::string gpu = "NVIDIA H200/PCIe/SSE2", software = "llvmpipe (LLVM 15.0.6, 256 bits)";
    const auto fine = [] {};
    const auto refused = [] { throw std::runtime_error("refused"); };
    const auto choice = [&](GlPath wanted, const std::string& renderer, const std::function<void()>& cells,
                            const std::function<void()>& tiles) {
        const GlPathChoice made = chooseGlPath(wanted, renderer, cells, tiles);
        return std::pair(made.path, made.reason);
    };
    using Made = std::pair<GlPath, std::string>;
    EXPECT_EQ(choice(GlPath::Auto, gpu, fine, fine), Made(GlPath::Measured, "GPU"));
    EXPECT_EQ(choice(GlPath::Auto, gpu, fine, refused), Made(GlPath::Resident, "refused"));
    EXPECT_EQ(choice(GlPath::Auto, gpu, refused, fine), Made(GlPath::Stream, "refused"));
    EXPECT_EQ(choice(GlPath::Auto, software, refused, refused), Made(GlPath::Stream, "software renderer"));
    EXPECT_EQ(choice(GlPath::Stream, gpu, refused, refused), Made(GlPath::Stream, "asked for"));
    EXPECT_EQ(choice(GlPath::Resident, software, fine, refused), Made(GlPath::Resident, "asked for"));
    EXPECT_EQ(choice(GlPath::Tiles, software, fine, fine), Made(GlPath::Tiles, "asked for"));
    EXPECT_THROW(chooseGlPath(GlPath::Tiles, gpu, fine, refused), std::runtime_error);
    EXPECT_THROW(chooseGlPath(GlPath::Tiles, gpu, refused, fine), std::runtime_error);
    EXPECT_THROW(chooseGlPath(GlPath::Measured, gpu, fine, refused), std::runtime_error);
    for (const std::string& name : glPathNames()) EXPECT_NO_THROW(parseGlPath(name));
}

/// Draws frames whose times are given, and says how often tiles were taken.
int tilesTaken(GlDrawTrial& trial, int frames, std::uint64_t pixels, std::uint64_t cells, double raster, double tiles) {
    int taken = 0;
    for (int i = 0; i < frames; ++i) {
        const bool isTiles = trial.next(pixels) == GlDrawing::Tiles;
        trial.took(isTiles ? tiles : raster, cells);
        taken += isTiles ? 1 : 0;
    }
    return taken;
}

TEST(GlDrawTrial, KeepsTheFaster) {
    GlDrawTrial tilesWin, rasterWins;
    EXPECT_EQ(tilesWin.reason(), "being measured");
    EXPECT_EQ(tilesTaken(tilesWin, 6, 1000, 500, 5.0, 2.0), 3);  // by turns
    EXPECT_EQ(tilesTaken(tilesWin, 20, 1000, 500, 5.0, 2.0), 20);
    EXPECT_EQ(tilesWin.reason(), "measured: raster 5 ms, tiles 2 ms");
    EXPECT_EQ(tilesTaken(rasterWins, 6, 1000, 500, 2.0, 5.0), 3);
    EXPECT_EQ(tilesTaken(rasterWins, 20, 1000, 500, 2.0, 5.0), 0);
}

TEST(GlDrawTrial, TheFirstOfEachDoesNotCountAndOneSlowFrameIsForgiven) {
    GlDrawTrial trial;
    const double times[] = {100, 900, 50, 4, 3, 60};  // raster, tiles, raster, tiles, …
    for (const double time : times) {
        trial.next(1000);
        trial.took(time, 500);
    }
    EXPECT_EQ(trial.reason(), "measured: raster 3 ms, tiles 4 ms");
    EXPECT_EQ(trial.next(1000), GlDrawing::Raster);
}

TEST(GlDrawTrial, IsRepeatedForAnotherSize) {
    GlDrawTrial trial;
    tilesTaken(trial, 6, 1000, 500, 5.0, 2.0);
    EXPECT_EQ(tilesTaken(trial, 4, 1900, 1900, 5.0, 2.0), 4);  // not twice as large
    EXPECT_EQ(tilesTaken(trial, 6, 2100, 1900, 2.0, 5.0), 3);  // larger: by turns again
    EXPECT_EQ(tilesTaken(trial, 4, 2100, 1900, 2.0, 5.0), 0);
    EXPECT_EQ(tilesTaken(trial, 1, 2100, 8000, 2.0, 5.0), 0);  // many more cells: noticed after the frame
    EXPECT_EQ(trial.reason(), "being measured");
    EXPECT_EQ(tilesTaken(trial, 6, 2100, 8000, 5.0, 2.0), 3);
    EXPECT_EQ(tilesTaken(trial, 4, 2100, 8000, 5.0, 2.0), 4);
}

// As `auto` has it on GPUs; whatever wins here, pictures are the same all along.
TEST(GlPath, MeasuredDrawsByTurnsThenStays) {
    const Scene scene = sceneOf(jitteredBoxMesh(6, 0.2, 5, waves), smoothFunction(0.1, 0.9));
    const auto measured = engineOf(scene, "measured");
    const Image expected = pictureOf(*engineOf(scene, "resident"), views()[0]).image;
    std::vector<std::string> paths;
    for (int i = 0; i < 9; ++i) {
        const PathPicture picture = pictureOf(*measured, views()[0]);
        EXPECT_LE(compareImages(picture.image, expected).max, roundingOnly);
        paths.push_back(picture.report.dataPath);
        EXPECT_EQ(picture.report.dataPathReason.rfind(i < 5 ? "being measured" : "measured: raster ", 0), 0u) << i;
    }
    for (std::size_t i = 0; i < 6; ++i) EXPECT_EQ(paths[i], i % 2 == 0 ? "resident" : "tiles");
    EXPECT_EQ(paths[7], paths[6]);
    EXPECT_EQ(paths[8], paths[6]);
}

}  // namespace
}  // namespace tetralux::projection
