// SPDX-License-Identifier: Apache-2.0
//
// The OpenGL engine with its cells on the GPU (gl_resident_cells.h) against the one that streams them: both compile the
// same formulas in doubles, so that records agree to the bit but for what a compiler contracts, and the order is the
// same. Here both run on llvmpipe.
#include <numeric>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include <projection/gl/gl_context.h>
#include <projection/gl/gl_frame_target.h>
#include <projection/gl/gl_path.h>
#include <projection/gl/gl_resident_cells.h>
#include <projection/order/key_sort.h>
#include <projection/order/visibility_order.h>
#include <projection/order/visibility_relations.h>
#include <tests/support/gl_path_pictures.h>

namespace tetralux::projection {
namespace {

using namespace tetralux::test;

void expectSame(const Scene& scene, const std::vector<View>& views) {
    test::expectSame(scene, views, "resident");
}

class ResidentModes : public testing::TestWithParam<Mode> {};

TEST_P(ResidentModes, LikeStream) {
    const Scene scene = sceneOf(jitteredBoxMesh(9, 0.2, 5, waves), smoothFunction(0.1, 0.9), GetParam());
    expectSame(scene, views());
}

INSTANTIATE_TEST_SUITE_P(All, ResidentModes, testing::ValuesIn(pathModes));

TEST(Resident, SilhouettesAndLights) {
    expectSame(litScene(8, false), {views()[0]});
    test::expectSame(litScene(8, true), views(), "resident", "auto");
}

TEST(Resident, CellDataAndInvisibleCells) {
    mesh::ScalarMesh m = jitteredBoxMesh(8, 0.2, 5, waves);
    std::vector<double> values;
    for (mesh::CellIndex cell = 0; cell < m.cells.size(); ++cell) values.push_back(m.scalarAt(cell, 1));
    m.association = mesh::Association::Cell;
    m.scalars = values;
    Scene scene = sceneOf(finished(std::move(m)), smoothFunction(0.1, 0.9));
    scene.transferFunction.extinction = {{0.0, 0.0}, {0.6, 0.0}, {1.0, 20.0}};
    expectSame(scene, {views()[0]});
}

TEST(Resident, WithinPixelMaps) {
    const Scene scene = sceneOf(jitteredBoxMesh(7, 0.1, 5, waves), smoothFunction(0.1, 0.9));
    const Camera camera = views()[0].camera;
    PixelMaps maps;
    const auto pixels = static_cast<std::size_t>(camera.width * camera.height);
    maps.nearest.assign(pixels, 2.4);
    maps.farthest.assign(pixels, 3.0);
    expectSame(scene, {View(camera, &maps)});
}

// An order that has no keys is made by the processor: four bytes a cell go up.
TEST(Resident, OrderOfTheGraph) {
    const auto hollow = [](const glm::dvec3& p) { return glm::length(p - glm::dvec3(0.5)) > 0.3; };
    Scene scene = sceneOf(carved(jitteredBoxMesh(9, 0.2, 5, waves), hollow), smoothFunction(0.1, 0.9));
    expectSame(scene, views());
    const PathPicture resident = pictureOf(*engineOf(scene, "resident"), views()[0]);
    EXPECT_EQ(resident.report.orderMethod, "mpvo+reentry");
    EXPECT_LE(resident.report.bytesUploaded, 4 * scene.mesh->cells.size() + 64);
    const PathPicture stream = pictureOf(*engineOf(scene, "stream"), views()[0]);
    EXPECT_GE(stream.report.bytesUploaded, 128 * stream.report.cellsDrawn);
}

// More than one chunk of cells, and more than one block of everything else; frames one after the other.
TEST(Resident, ManyCells) {
    const Scene scene = sceneOf(boxMesh(33, waves), smoothFunction(0.1, 0.9));
    ASSERT_GT(scene.mesh->cells.size(), std::size_t{1} << 17);
    const auto resident = engineOf(scene, "resident"), stream = engineOf(scene, "stream");
    for (const double fov : {30.0, 3.0, 40.0}) {
        Camera camera = views()[0].camera;
        camera.eye = {1.93, 1.37, 2.21};  // within no plane of the grid: doubles would round there
        camera.fovDegrees = fov;
        FrameReport one, two;
        EXPECT_LE(compareImages(resident->render(camera, one), stream->render(camera, two)).max, roundingOnly);
        EXPECT_EQ(one.cellsDrawn, two.cellsDrawn);
        EXPECT_EQ(one.orderMethod, "power");
        EXPECT_LE(one.bytesUploaded, 64u) << "nothing but the camera";
    }
    Camera away = views()[0].camera;
    away.target = away.eye + (away.eye - away.target);
    FrameReport none;
    for (const glm::vec4& pixel : resident->render(away, none).pixels) ASSERT_EQ(pixel, glm::vec4(0));
    EXPECT_EQ(none.cellsDrawn, 0u);
}

// A clump of cells a hundred thousandth of the mesh's size: whole-number keys cannot tell them apart, doubles can.
TEST(Resident, TiesAreSettled) {
    for (const int n : {3, 9}) {
        const auto [scene, camera] = clumpOfCells(n, 1e-5);
        const PathPicture stream = pictureOf(*engineOf(scene, "stream"), camera);
        const PathPicture resident = pictureOf(*engineOf(scene, "resident"), camera);
        EXPECT_GT(stream.report.cellsDrawn, n == 3 ? 20u : 1000u);
        EXPECT_LE(compareImages(stream.image, resident.image).max, roundingOnly);
        EXPECT_EQ(resident.report.dataPath, "resident") << n;
    }
}

// Keys that are no visibility order are found out: those of centroids, of a mesh whose cells differ in shape.
TEST(Resident, BrokenRelationsAreNoticed) {
    const mesh::ScalarMesh m = jitteredBoxMesh(7, 0.1, 5, waves);
    VisibilitySorter sorter(m);
    ASSERT_EQ(sorter.method(), "power");
    const OrderKeys centroid = OrderKeys::centroid(m);
    std::vector<mesh::CellIndex> all(m.cells.size());
    std::iota(all.begin(), all.end(), mesh::CellIndex{0});
    const auto context = makeGlContext("auto");
    const CurrentGlContext current(*context);
    const auto gl = loadGlFunctions(*context);
    for (const View& view : views())
        for (const OrderKeys* keys : {&sorter.keys(), &centroid}) {
            GlResidentCells cells(*gl, m, sceneUnits(m), all, keys, &sorter.adjacency(), {}, {});
            const CameraFrame frame = cameraFrame(view.camera);
            GlFrameTarget target(*gl);
            target.begin(frame.width, frame.height, 0.0f);
            cells.draw(frame, nullptr, 0.01, [] {});
            std::vector<mesh::CellIndex> drawn;
            const CellProjector projector(m, sceneUnits(m), frame);
            PixelRect rect;
            for (const mesh::CellIndex cell : all)
                if (projector.bounds(cell, rect) == SkipReason::None) drawn.push_back(cell);
            KeySorter().sort(*keys, keys->eye(frame), drawn);
            std::vector<std::uint32_t> places;
            EXPECT_EQ(cells.counts().unsettled == 0, keepsFaceRelations(sorter.adjacency(), projector, drawn, places));
            EXPECT_TRUE(keys == &centroid || cells.counts().unsettled == 0);
            EXPECT_TRUE(keys != &centroid || drawn.size() < 500 || cells.counts().unsettled != 0);
        }
}

TEST(GlPath, TheRule) {
    EXPECT_TRUE(isSoftwareRenderer("llvmpipe (LLVM 15.0.6, 256 bits)"));
    EXPECT_TRUE(isSoftwareRenderer("softpipe"));
    EXPECT_FALSE(isSoftwareRenderer("NVIDIA H200/PCIe/SSE2"));
    EXPECT_FALSE(isSoftwareRenderer("AMD Radeon RX 6600 (navi23, LLVM 15.0.6, DRM 3.49)"));
    EXPECT_EQ(parseGlPath("resident"), GlPath::Resident);
    EXPECT_THROW(parseGlPath("fast"), std::runtime_error);
    const Scene scene = sceneOf(boxMesh(4, waves), smoothFunction(0.1, 0.9));
    const PathPicture picture = pictureOf(*engineOf(scene, "auto", "osmesa"), views()[0]);  // always software
    EXPECT_EQ(picture.report.dataPath, "stream");
    EXPECT_EQ(picture.report.dataPathReason, "software renderer");
}

}  // namespace
}  // namespace tetralux::projection
