// SPDX-License-Identifier: Apache-2.0
#include <tetralux/tetralux.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <numeric>
#include <random>
#include <thread>

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <mesh/soup/cell_types.h>
#include <projection/frame/engine_registry.h>
#include <projection/frame/suggested_extinction.h>
#include <tests/support/analytic_scenes.h>

namespace tetralux {
namespace {

struct Arrays {
    std::vector<double> xyz, values;
    std::vector<std::uint32_t> cells;
};

Arrays arraysOf(const mesh::ScalarMesh& m) {
    Arrays arrays;
    for (const glm::dvec3& p : m.positions) arrays.xyz.insert(arrays.xyz.end(), {p.x, p.y, p.z});
    for (const mesh::Tetrahedron& cell : m.cells) arrays.cells.insert(arrays.cells.end(), cell.begin(), cell.end());
    arrays.values.assign(m.scalars.begin(), m.scalars.end());
    return arrays;
}

Arrays bucky(int n) {
    return arraysOf(test::sampledMesh(mesh::proceduralField("bucky", n), n));
}

/// A picture in memory of its own, with room beside the rows that must stay as it is.
struct Picture {
    static constexpr int beside = 3;
    static constexpr float untouched = -7.0f;
    int width, height;
    std::vector<float> floats;

    Picture(int w, int h) : width(w), height(h), floats(static_cast<std::size_t>((4 * w + beside) * h), untouched) {}
    ImageView view() { return {floats.data(), width, height, 4 * width + beside}; }
    const float* at(int x, int y) const { return floats.data() + (4 * width + beside) * y + 4 * x; }
    double alphaSum() const {
        double sum = 0;
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x) sum += at(x, y)[3];
        return sum;
    }
};

double largestDifference(const Picture& a, const Picture& b) {
    double largest = 0;
    for (std::size_t i = 0; i < a.floats.size(); ++i)
        largest = std::max<double>(largest, std::abs(a.floats[i] - b.floats[i]));
    return largest;
}

const Camera corner{{1.9, 1.4, 2.3}, {0.5, 0.5, 0.5}};

TransferFunction steep() {
    return TransferFunction::parse(
        R"({"color": [[0, 0, 0, 1], [1, 1, 0.5, 0]], "extinction": [[0, 0], [1, 30]],
            "isosurfaces": [{"value": 0.5, "opacity": 0.4, "color": [0, 1, 0]}]})");
}

Renderer rendererOf(const Arrays& arrays, RendererOptions options = {}) {
    Renderer renderer(Mesh::fromTetrahedra(arrays.xyz, arrays.cells), std::move(options));
    renderer.setField(Field::onPoints(arrays.values));
    return renderer;
}

void expectBadInput(const std::function<void()>& work, const std::string& part) {
    try {
        work();
        ADD_FAILURE() << "nothing was thrown; expected: " << part;
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), Errc::BadInput);
        EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
        EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
    }
}

TEST(Renderer, DrawsWhatTheEngineDrawsToTheBit) {
    const auto m = std::make_shared<const mesh::ScalarMesh>(test::sampledMesh(mesh::proceduralField("bucky", 12), 12));
    projection::Scene scene;
    scene.mesh = m;
    scene.transferFunction = projection::resolvedFor(preint::preset("viridis"), *m, {});
    projection::Camera camera;
    camera.eye = {1.9, 1.4, 2.3};
    camera.target = {0.5, 0.5, 0.5};
    camera.width = 80;
    camera.height = 60;
    projection::FrameReport report;
    const projection::Image expected = projection::makeEngine(scene, {})->render(camera, report);

    Renderer renderer = rendererOf(arraysOf(*m));
    renderer.setTransferFunction(TransferFunction::preset("viridis"));
    Picture picture(80, 60);
    const FrameResult result = renderer.render(corner, picture.view());
    EXPECT_TRUE(result.complete);
    EXPECT_EQ(result.cellsDrawn, report.cellsDrawn);
    for (int y = 0; y < 60; ++y)
        EXPECT_EQ(std::memcmp(picture.at(0, y), &expected.at(0, y), 80 * sizeof(glm::vec4)), 0) << y;
    for (int y = 0; y < 60; ++y)
        for (int i = 0; i < Picture::beside; ++i) EXPECT_EQ(picture.at(80, y)[i], Picture::untouched);
}

TEST(Renderer, WhatIsKeptChangesNothing) {
    const Arrays arrays = bucky(12);
    std::vector<double> other(arrays.values);
    for (double& value : other) value = std::sqrt(value);
    Renderer kept = rendererOf(arrays);
    const auto compare = [&](const char* what, const std::function<void(Renderer&)>& change) {
        change(kept);
        Picture a(64, 64), b(64, 64);
        kept.render(corner, a.view());
        Renderer fresh = rendererOf(arrays);
        change(fresh);
        fresh.render(corner, b.view());
        EXPECT_EQ(largestDifference(a, b), 0.0) << what;
        EXPECT_GT(a.alphaSum(), 10.0) << what;
    };
    compare("nothing", [](Renderer&) {});
    compare("transfer function", [](Renderer& r) { r.setTransferFunction(steep()); });
    compare("field", [&](Renderer& r) {
        r.setTransferFunction(steep());
        r.setField(Field::onPoints(other));
    });
    compare("light", [&](Renderer& r) {
        r.setTransferFunction(steep());
        r.setField(Field::onPoints(other));
        r.setLighting({{Light{}}, 0.2, 16});
    });
    compare("cut, silhouettes, integral", [&](Renderer& r) {
        r.setTransferFunction(steep());
        r.setField(Field::onPoints(other));
        r.setLighting({{Light{}}, 0.2, 16});
        r.setCuts({{{0.4, 0.5, 0.5}, {1, 0.2, 0}}});
        r.setSilhouettes(Silhouettes::Exact);
        r.setMode(Mode::ScaleInvariant);
    });
}

TEST(Renderer, ThreadsAndArenasChangeNothingAndRenderersShareAMesh) {
    const Arrays arrays = bucky(14);
    const auto mesh = Mesh::fromTetrahedra(arrays.xyz, arrays.cells);
    tbb::task_arena hosts(2);
    std::vector<RendererOptions> options(4);
    options[1].threads = 1;
    options[2].threads = 3;
    options[3].arena = [&](const std::function<void()>& work) { hosts.execute(work); };
    std::vector<Picture> pictures(options.size(), Picture(70, 50));
    std::vector<std::thread> threads;
    for (std::size_t i = 0; i < options.size(); ++i)
        threads.emplace_back([&, i] {
            Renderer renderer(mesh, options[i]);
            renderer.setField(Field::onPoints(arrays.values));
            renderer.setTransferFunction(steep());
            for (int frame = 0; frame < 3; ++frame) renderer.render(corner, pictures[i].view());
        });
    for (std::thread& thread : threads) thread.join();
    for (std::size_t i = 1; i < pictures.size(); ++i) EXPECT_EQ(largestDifference(pictures[0], pictures[i]), 0.0) << i;
}

TEST(Renderer, TilesAndOffCentreViewsArePartsOfAWholePicture) {
    const Arrays arrays = bucky(10);
    for (const char* engine : {"cpu", "reference"})
        for (const double height : {0.0, 1.3}) {
            Renderer renderer = rendererOf(arrays, {engine});
            renderer.setTransferFunction(steep());
            Camera camera = corner;
            camera.orthographicHeight = height;
            camera.windowCentre = {0.1, -0.2};
            Picture whole(64, 48), part(24, 16);
            renderer.render(camera, whole.view());
            Control control;
            control.tile = {30, 20, 64, 48};
            renderer.render(camera, part.view(), control);
            // a pixel's place before the eye is rounded once more than in the whole
            for (int y = 0; y < 16; ++y)
                for (int x = 0; x < 24; ++x)
                    for (int c = 0; c < 4; ++c)
                        EXPECT_NEAR(part.at(x, y)[c], whole.at(x + 30, y + 20)[c], 2e-5) << engine << x << ' ' << y;
            // moving the window by whole pixels moves the picture
            Picture moved(64, 48);
            camera.windowCentre = {0.1 + 2.0 * 8 / 64, -0.2 + 2.0 * 4 / 48};
            renderer.render(camera, moved.view());
            for (int y = 4; y < 48; ++y)
                for (int x = 0; x < 56; ++x)
                    EXPECT_NEAR(moved.at(x, y)[3], whole.at(x + 8, y - 4)[3], 2e-5) << engine << x << ' ' << y;
        }
}

TEST(Renderer, DepthLimitAndRegionEndRaysWhereTheyShould) {
    // a medium of one extinction in the unit cube, seen along z: alpha = 1 − exp(−τ · length)
    const Arrays arrays = arraysOf(test::boxMesh(5, [](const glm::dvec3& p) { return p.x; }));
    Renderer renderer = rendererOf(arrays);
    renderer.setTransferFunction(TransferFunction::parse(R"({"color": [[0, 1, 1, 1]], "extinction": [[0, 2]]})"));
    Camera camera{{0.5, 0.5, 4}, {0.5, 0.5, 0.5}};
    camera.orthographicHeight = 0.8;
    Picture picture(16, 16);
    std::vector<float> limit(16 * 16, std::numeric_limits<float>::infinity());
    for (std::size_t i = 0; i < limit.size(); i += 2) limit[i] = 3.25f;  // a quarter of the cube, from z = 1
    Control control;
    control.depthLimit = limit.data();
    renderer.render(camera, picture.view(), control);
    EXPECT_NEAR(picture.at(4, 8)[3], 1 - std::exp(-2 * 0.25), 1e-6);
    EXPECT_NEAR(picture.at(5, 8)[3], 1 - std::exp(-2 * 1.0), 1e-6);
    control.depthLimit = nullptr;
    control.region = {{0, 0, 0.3}, {0.5, 1, 0.7}};
    renderer.render(camera, picture.view(), control);
    EXPECT_NEAR(picture.at(4, 8)[3], 1 - std::exp(-2 * 0.4), 1e-6);
    EXPECT_EQ(picture.at(12, 8)[3], 0.0f);
    // parts of space, composed front to back, are the whole
    Picture behind(16, 16), whole(16, 16);
    control.region = {{0, 0, -1}, {1, 1, 0.6}};
    renderer.render(camera, behind.view(), control);
    control.region = {{0, 0, 0.6}, {1, 1, 2}};
    renderer.render(camera, picture.view(), control);
    renderer.render(camera, whole.view());
    for (int c = 0; c < 4; ++c)
        EXPECT_NEAR(picture.at(6, 6)[c] + (1 - picture.at(6, 6)[3]) * behind.at(6, 6)[c], whole.at(6, 6)[c], 1e-6);
    limit[0] = std::numeric_limits<float>::quiet_NaN();
    control.depthLimit = limit.data();
    expectBadInput([&] { renderer.render(camera, picture.view(), control); }, "depth limit: pixel 0,0");
}

TEST(Renderer, StoppedFramesAreTransparentAndTheNextIsRight) {
    const Arrays arrays = bucky(20);
    for (const char* engine : {"cpu", "reference"}) {
        Renderer renderer = rendererOf(arrays, {engine});
        Picture right(48, 48), picture(48, 48);
        renderer.render(corner, right.view());
        std::stop_source source;
        Control control;
        control.stop = source.get_token();
        std::vector<double> shares;
        control.progress = [&](double share) {
            shares.push_back(share);
            if (shares.size() == 2) source.request_stop();
        };
        if (std::string(engine) == "reference") source.request_stop();
        const FrameResult stopped = renderer.render(corner, picture.view(), control);
        EXPECT_FALSE(stopped.complete) << engine;
        EXPECT_EQ(picture.alphaSum(), 0.0) << engine;
        EXPECT_EQ(shares.front(), 0.0) << engine;
        EXPECT_TRUE(renderer.render(corner, picture.view()).complete);
        EXPECT_EQ(largestDifference(right, picture), 0.0) << engine;
    }
}

TEST(Renderer, ABudgetMakesCoarserPictures) {
    const Arrays arrays = bucky(16);
    Renderer renderer = rendererOf(arrays);
    Picture exact(200, 150), picture(200, 150);
    Control control;
    control.budgetMilliseconds = 1e-3;  // no machine is as fast
    const FrameResult coarse = renderer.render(corner, picture.view(), control);
    EXPECT_TRUE(coarse.complete);
    EXPECT_LT(coarse.drawnWidth, 200);
    EXPECT_GT(picture.alphaSum(), 0.0);
    control.budgetMilliseconds = 1e9;
    renderer.render(corner, picture.view(), control);  // now that it is known what frames cost
    const FrameResult whole = renderer.render(corner, exact.view());
    EXPECT_EQ(whole.drawnWidth, 200);
    EXPECT_EQ(largestDifference(exact, picture), 0.0);
}

TEST(Renderer, ABudgetKeepsToTheDepthLimit) {
    Renderer renderer = rendererOf(bucky(16));
    Picture picture(200, 150);
    std::vector<float> limit(200 * 150, 0.0f);
    for (std::size_t i = 0; i < limit.size(); ++i)
        if (i % 200 >= 100) limit[i] = std::numeric_limits<float>::infinity();
    Control control;
    control.budgetMilliseconds = 1e-3;
    control.depthLimit = limit.data();
    const FrameResult coarse = renderer.render(corner, picture.view(), control);
    EXPECT_LT(coarse.drawnWidth, 200);
    double left = 0, right = 0;
    for (int y = 0; y < 150; ++y)
        for (int x = 0; x < 200; ++x) {
            const double alpha = picture.at(x, y)[3];
            if (x < 70) left += alpha;  // a pixel of the coarse picture is some 25 wide
            if (x >= 130) right += alpha;
        }
    EXPECT_EQ(left, 0.0);
    EXPECT_GT(right, 1.0);
}

TEST(Renderer, SamplesAreTheMeanOfALargerPicture) {
    Renderer renderer = rendererOf(bucky(12));
    Picture larger(80, 60), averaged(40, 30);
    renderer.render(corner, larger.view());
    renderer.setSamples(3);  // the next square is 4
    renderer.render(corner, averaged.view());
    for (int y = 0; y < 30; ++y)
        for (int x = 0; x < 40; ++x)
            for (int c = 0; c < 4; ++c) {
                const double mean = 0.25 * (double{larger.at(2 * x, 2 * y)[c]} + larger.at(2 * x + 1, 2 * y)[c] +
                                            larger.at(2 * x, 2 * y + 1)[c] + larger.at(2 * x + 1, 2 * y + 1)[c]);
                EXPECT_NEAR(averaged.at(x, y)[c], mean, 1e-6);
            }
    for (const int samples : {0, -1, 65}) expectBadInput([&] { renderer.setSamples(samples); }, "give 1 to 64");
}

TEST(Renderer, LightsByADocumentAreThoseOfTheStruct) {
    Renderer renderer = rendererOf(bucky(12));
    Lighting lighting;
    lighting.lights.push_back({});
    lighting.lights.back().direction = {1, 2, 2};
    lighting.ambient = 0.3;
    Picture a(48, 36), b(48, 36);
    renderer.setLighting(lighting);
    renderer.render(corner, a.view());
    renderer.setLighting(R"({"ambient": 0.3, "lights": [{"type": "directional", "towards": [1, 2, 2]}]})");
    renderer.render(corner, b.view());
    EXPECT_EQ(largestDifference(a, b), 0.0);
    renderer.setLighting(Lighting{});
    renderer.render(corner, b.view());
    EXPECT_GT(largestDifference(a, b), 0.01);
    expectBadInput([&] { renderer.setLighting("{]"); }, "is not JSON");
    expectBadInput([&] { renderer.setLighting(R"({"lights": [{"type": "laser"}]})"); }, "directional");
}

TEST(Renderer, AViewThatHoldsTheMeshIsLikeTheCameraGiven) {
    const BoundingBox box{{0, 0, 0}, {1, 1, 1}};
    Camera wide;
    wide.fovDegrees = 60;
    const auto distance = [](const Camera& camera) {
        return std::hypot(camera.eye[0] - 0.5, camera.eye[1] - 0.5, camera.eye[2] - 0.5);
    };
    EXPECT_NEAR(distance(cameraHolding(box, 100, 80, wide)), 0.5 * std::sqrt(3.0) / 0.5, 1e-12);
    EXPECT_GT(distance(cameraHolding(box, 100, 80)), 3.0);
    EXPECT_EQ(cameraHolding(box, 100, 80, wide).fovDegrees, 60);
}

TEST(Renderer, VerifiesAndProbes) {
    const Arrays arrays = arraysOf(test::boxMesh(5, [](const glm::dvec3& p) { return 1 - p.z; }));
    Renderer renderer = rendererOf(arrays);
    renderer.setTransferFunction(TransferFunction::parse(
        R"({"color": [[0, 1, 1, 1]], "extinction": [[0.25, 0], [0.25, 2]]})"));  // from 0.25 on, at z = 0.75
    const Camera camera{{0.4, 0.45, 3}, {0.4, 0.45, 0}};
    Picture picture(33, 33);
    expectBadInput([&] { renderer.probe(camera, 16, 16); }, "no frame yet");
    renderer.render(camera, picture.view());
    const Verification found = renderer.verify(camera, picture.view(), 300);
    EXPECT_EQ(found.pixels, 300u);
    EXPECT_LT(found.max, 1e-5);
    picture.floats[4 * 16 + (4 * 33 + Picture::beside) * 16] += 0.5f;
    EXPECT_GT(renderer.verify(camera, picture.view(), 33 * 33).max, 0.4);

    const PixelProbe probe = renderer.probe(camera, 16, 16);
    ASSERT_TRUE(probe.hit);
    EXPECT_NEAR(probe.distance, 2.25, 1e-9);
    EXPECT_NEAR(probe.scalar, 0.25, 1e-9);
    EXPECT_NEAR(probe.position[2], 0.75, 1e-9);
    double length = 0;
    for (const auto& segment : probe.segments) length += segment.end - segment.begin;
    EXPECT_NEAR(length, 1.0, 1e-9);
    EXPECT_FALSE(renderer.probe({{5, 5, 3}, {5, 5, 0}}, 3, 3).hit);
    expectBadInput([&] { renderer.probe(camera, 33, 0); }, "pixel 33,0 lies outside 33x33");
    expectBadInput([&] { renderer.verify({{0, 0, 9}}, picture.view(), 10); }, "not the last frame");
}

TEST(Mesh, KeepsTrackOfValuesThroughWhatItLeavesOut) {
    Arrays arrays = bucky(6);
    const auto clean = Mesh::fromTetrahedra(arrays.xyz, arrays.cells);
    // a point that no cell uses in front, an inverted cell, a flat one, one out of range, one twice
    Arrays faulty;
    faulty.xyz = {9, 9, 9};
    faulty.xyz.insert(faulty.xyz.end(), arrays.xyz.begin(), arrays.xyz.end());
    for (const std::uint32_t p : arrays.cells) faulty.cells.push_back(p + 1);
    std::swap(faulty.cells[0], faulty.cells[1]);
    std::vector<std::uint32_t> bad{1, 2, 3, 3, 1, 2, 3, 100000};
    bad.insert(bad.end(), faulty.cells.begin() + 4, faulty.cells.begin() + 8);
    faulty.cells.insert(faulty.cells.begin() + 8, bad.begin(), bad.end());
    MeshReport report;
    const auto mended = Mesh::fromTetrahedra(faulty.xyz, faulty.cells, &report);
    EXPECT_EQ(mended->tetrahedra(), clean->tetrahedra());
    EXPECT_EQ(mended->points(), clean->points() + 1);
    EXPECT_EQ(mended->cells(), clean->cells() + 3);
    EXPECT_EQ(report.defects.at("inverted cell"), 1u);
    EXPECT_EQ(report.skipped.size(), 3u);

    const auto picture = [](std::shared_ptr<const Mesh> mesh, Field field) {
        Renderer renderer(std::move(mesh));
        renderer.setField(std::move(field));
        Picture result(40, 40);
        renderer.render(corner, result.view());
        return result;
    };
    faulty.values = {-1e9};
    faulty.values.insert(faulty.values.end(), arrays.values.begin(), arrays.values.end());
    EXPECT_LT(largestDifference(picture(clean, Field::onPoints(arrays.values)),
                                picture(mended, Field::onPoints(faulty.values))),
              1e-6);
    std::vector<double> ofCells(clean->cells());
    std::iota(ofCells.begin(), ofCells.end(), 0.0);
    std::vector<float> ofFaulty(ofCells.begin(), ofCells.begin() + 2);
    ofFaulty.insert(ofFaulty.end(), {-1e9f, 1e9f, 5e8f});
    ofFaulty.insert(ofFaulty.end(), ofCells.begin() + 2, ofCells.end());
    EXPECT_LT(largestDifference(picture(clean, Field::onCells(ofCells)), picture(mended, Field::onCells(ofFaulty))),
              1e-5);
}

TEST(Mesh, BorrowsWhatFitsAndTakesFloats) {
    const auto arrays = std::make_shared<Arrays>(bucky(8));
    const std::weak_ptr<Arrays> watch = arrays;
    auto mesh = Mesh::borrow(arrays->xyz, arrays->cells, arrays);
    const std::vector<float> floats(arrays->xyz.begin(), arrays->xyz.end());
    const auto fromFloats = Mesh::fromTetrahedra(floats, arrays->cells);
    EXPECT_NEAR(fromFloats->bounds().diagonal(), std::sqrt(3.0), 1e-6);
    Picture a(32, 32), b(32, 32);
    {
        Renderer borrowed(mesh);
        borrowed.setField(Field::borrowOnPoints(arrays->values, arrays));
        borrowed.render(corner, a.view());
        Renderer copied = rendererOf(*arrays);
        copied.render(corner, b.view());
    }
    EXPECT_EQ(largestDifference(a, b), 0.0);
    const long uses = arrays.use_count();
    EXPECT_GT(uses, 1);
    mesh.reset();
    EXPECT_EQ(arrays.use_count(), 1);
}

TEST(Mesh, ShowsWhatIsDrawn) {
    const Arrays arrays = bucky(4);
    const auto mesh = Mesh::fromTetrahedra(arrays.xyz, arrays.cells);
    EXPECT_TRUE(std::ranges::equal(mesh->positions(), arrays.xyz));
    EXPECT_TRUE(std::ranges::equal(mesh->corners(), arrays.cells));
}

TEST(Mesh, TakesCellsOfAnyKind) {
    // one hexahedron, and the same as a quadratic one whose edges are straight
    const std::vector<double> corners{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0, 1, 1, 0, 1, 1, 1, 1, 0, 1, 1};
    std::vector<double> quadratic = corners;
    const int edges[12][2] = {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6},
                              {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}};
    for (const auto& edge : edges)
        for (int axis = 0; axis < 3; ++axis)
            quadratic.push_back(0.5 * (corners[static_cast<std::size_t>(3 * edge[0] + axis)] +
                                       corners[static_cast<std::size_t>(3 * edge[1] + axis)]));
    const auto values = [](const std::vector<double>& xyz) {
        std::vector<double> result;
        for (std::size_t i = 0; i < xyz.size(); i += 3) result.push_back(xyz[i] + 0.5 * xyz[i + 2]);
        return result;
    };
    const auto draw = [&](const std::vector<double>& xyz, std::uint8_t type) {
        const auto points = static_cast<std::int64_t>(xyz.size() / 3);
        std::vector<std::int64_t> connectivity(static_cast<std::size_t>(points));
        std::iota(connectivity.begin(), connectivity.end(), 0);
        const std::vector<std::uint8_t> types{type};
        const std::vector<std::int64_t> offsets{0, points};
        MeshReport report;
        Renderer renderer(Mesh::fromCells(xyz, types, offsets, connectivity, &report));
        EXPECT_EQ(report.cellsRead, 1u);
        renderer.setField(Field::onPoints(values(xyz)));
        renderer.setTransferFunction(steep());
        Picture picture(32, 32);
        renderer.render(corner, picture.view());
        return picture;
    };
    const Picture linear = draw(corners, mesh::cell_type::hexahedron), curved = draw(quadratic, 25);
    EXPECT_GT(linear.alphaSum(), 100.0);
    EXPECT_LT(largestDifference(linear, curved), 1e-5);
}

TEST(Mesh, RefusesWhatNobodyCouldDraw) {
    const std::vector<double> xyz{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
    const std::vector<std::uint32_t> one{0, 1, 2, 3}, none, three{0, 1, 2}, flat{0, 1, 2, 2};
    const std::vector<double> two{0, 0};
    expectBadInput([&] { Mesh::fromTetrahedra(two, one); }, "points: 2 numbers");
    expectBadInput([&] { Mesh::fromTetrahedra(xyz, three); }, "cells: 3 numbers");
    expectBadInput([&] { Mesh::fromTetrahedra(xyz, none); }, "no cells");
    expectBadInput([&] { Mesh::fromTetrahedra(xyz, flat); }, "no solid cell is left");
    const std::vector<std::uint8_t> types{10};
    const std::vector<std::int64_t> good{0, 4}, falling{4, 0}, beyond{0, 5}, numbers{0, 1, 2, 3}, outside{0, 1, 2, -1};
    expectBadInput([&] { Mesh::fromCells(xyz, types, falling, numbers); }, "offsets");
    expectBadInput([&] { Mesh::fromCells(xyz, types, beyond, numbers); }, "offsets");
    expectBadInput([&] { Mesh::fromCells(xyz, types, good, outside); }, "no solid cell is left");
    expectBadInput([&] { Renderer(nullptr); }, "no mesh");
    expectBadInput([&] { Renderer(Mesh::fromTetrahedra(xyz, one), {"vulkan"}); }, "no engine 'vulkan'");
    Renderer renderer(Mesh::fromTetrahedra(xyz, one));
    Picture picture(8, 8);
    expectBadInput([&] { renderer.render(corner, picture.view()); }, "no field");
    renderer.setField(Field::onPoints(two));
    expectBadInput([&] { renderer.render(corner, picture.view()); }, "2 values for 4 points");
    const std::vector<double> nan(4, std::nan(""));
    renderer.setField(Field::onPoints(nan));
    expectBadInput([&] { renderer.render(corner, picture.view()); }, "NaN");
    const std::vector<double> fine{0, 1, 2, 3};
    renderer.setField(Field::onPoints(fine));
    expectBadInput([&] { renderer.render(Camera{{0, 0, 0}, {0, 0, 0}}, picture.view()); }, "eye and target");
    expectBadInput([&] { renderer.render(corner, {}); }, "image: no memory");
    expectBadInput([&] { renderer.render(corner, {picture.floats.data(), 8, 8, 16}); }, "rows of 16 floats");
    expectBadInput([&] { TransferFunction::parse("{"); }, "transfer function");
    expectBadInput([&] { TransferFunction::preset("plum"); }, "viridis");
    EXPECT_TRUE(renderer.render(corner, picture.view()).complete);  // and goes on
}

TEST(Engines, AreListedWithWhatKeepsThemFromRunning) {
    const std::vector<EngineInfo> all = engines();
    ASSERT_GE(all.size(), 3u);
    EXPECT_EQ(all.front().name, "cpu");
    EXPECT_TRUE(all.front().available);
    for (const EngineInfo& engine : all) EXPECT_EQ(engine.available, engine.whyNot.empty()) << engine.name;
}

}  // namespace
}  // namespace tetralux
