// SPDX-License-Identifier: Apache-2.0
//
// What `tetralux view` shows and how commands change it, without a window.
#include <gtest/gtest.h>

#include <cmath>

#include <glm/geometric.hpp>

#include <apps/view/camera_moves.h>
#include <apps/view/option_words.h>
#include <apps/view/transfer_nodes.h>
#include <apps/view/view_state.h>

namespace {

using namespace tetralux;
using namespace tetralux::apps::view;

projection::Camera someCamera() {
    projection::Camera camera;
    camera.eye = {3, 2, 5};
    camera.target = {0.5, 0.25, 0};
    camera.width = 400;
    camera.height = 300;
    return camera;
}

/// Where a point is seen, pixels.
glm::dvec2 seenAt(const projection::Camera& camera, const glm::dvec3& point) {
    const projection::CameraFrame frame = projection::cameraFrame(camera);
    const glm::dvec3 way = point - frame.eye;
    const double depth = frame.orthographic ? 1.0 : glm::dot(way, frame.forward);
    const double x = glm::dot(way, frame.right) / glm::length(frame.perPixelRight) / depth;
    const double y = -glm::dot(way, frame.up) / glm::length(frame.perPixelDown) / depth;
    return frame.centre + glm::dvec2(x, y);
}

void expectNear(const glm::dvec2& a, const glm::dvec2& b) {
    EXPECT_NEAR(a.x, b.x, 1e-9);
    EXPECT_NEAR(a.y, b.y, 1e-9);
}

class Standing : public Shown {
public:
    projection::Camera camera() override { return camera_; }
    preint::TransferFunction function() override {
        preint::TransferFunction function;
        function.color = {{0, {0, 0, 1}}, {1, {1, 0, 0}}};
        function.extinction = {{0, 0}, {1, 2}};
        return function;
    }
    std::vector<double> times() override { return {0, 0.1, 0.3}; }
    glm::dvec3 pointUnder(const glm::dvec2&) override { return {1, 2, 3}; }
    projection::Camera camera_ = someCamera();
};

TEST(OptionWords, TakeThePlaceOfThoseOfTheirName) {
    OptionWords words;
    words.mesh = "bucky:8";
    words.add("--slice", "a");
    words.add("--mode", "mip");
    words.add("--slice", "b");
    EXPECT_EQ(words.valuesOf("--slice"), (std::vector<std::string>{"a", "b"}));
    words.set("--slice", "c");
    EXPECT_EQ(words.arguments(), (std::vector<std::string>{"bucky:8", "--slice=c", "--mode=mip"}));
    words.setFlag("--log", true);
    words.remove("--mode");
    EXPECT_EQ(words.commandLine("a b.png"), "tetralux render bucky:8 --slice=c --log -o 'a b.png'");
}

TEST(OptionWords, AreReadBackAsAShellDoes) {
    for (const char* word : {"plain", "", "two words", "it's", R"({"color":[[0,1,0,0]]})", "a\\b", "#no", "$HOME"})
        EXPECT_EQ(shellSplit("x " + shellQuoted(word)), (std::vector<std::string>{"x", word})) << word;
    EXPECT_EQ(shellSplit("turn 1 2 # round"), (std::vector<std::string>{"turn", "1", "2"}));
    EXPECT_THROW(shellSplit("a 'b"), std::runtime_error);
}

TEST(CameraMoves, TurntableKeepsDistanceAndStopsBeforeThePoles) {
    const projection::Camera from = someCamera();
    projection::Camera turned = turntable(from, {30, 10});
    EXPECT_NEAR(glm::length(turned.eye - turned.target), glm::length(from.eye - from.target), 1e-12);
    EXPECT_EQ(turned.target, from.target);
    // what is right of the target comes nearer when the eye goes right
    const glm::dvec3 right = projection::cameraFrame(from).right;
    EXPECT_GT(glm::dot(turned.eye - from.eye, right), 0);
    EXPECT_GT(turned.eye.y, from.eye.y);
    turned = turntable(from, {0, 500});
    const glm::dvec3 back = glm::normalize(turned.eye - turned.target);
    EXPECT_NEAR(std::asin(back.y) * 180 / 3.14159265358979, 89, 1e-6);
    for (int i = 0; i < 12; ++i) turned = turntable(i == 0 ? from : turned, {30, 0});
    EXPECT_NEAR(glm::length(turned.eye - from.eye), 0, 1e-9);
}

TEST(CameraMoves, TrackballPassesThePoles) {
    projection::Camera camera = someCamera();
    for (int i = 0; i < 36; ++i) camera = trackball(camera, {0, 10});
    EXPECT_NEAR(glm::length(camera.eye - someCamera().eye), 0, 1e-9);
}

TEST(CameraMoves, PanAndZoomFollowThePointer) {
    for (const double height : {0.0, 2.5}) {
        projection::Camera camera = someCamera();
        camera.orthographicHeight = height;
        const glm::dvec2 middle = seenAt(camera, camera.target);
        expectNear(seenAt(panned(camera, {12, -7}), camera.target), middle + glm::dvec2(12, -7));
        // what is at the target's distance under the pointer stays under it
        const projection::CameraFrame frame = projection::cameraFrame(camera);
        const glm::dvec3 point = camera.target + 0.3 * frame.right - 0.2 * frame.up;
        const glm::dvec2 pointer = seenAt(camera, point);
        const projection::Camera nearer = zoomedTo(camera, 1.7, pointer);
        expectNear(seenAt(nearer, point), pointer);
        expectNear(seenAt(zoomedTo(nearer, 1 / 1.7, pointer), camera.target), middle);
    }
}

TEST(CameraMoves, OtherProjectionKeepsTheSizeAtTheTarget) {
    const projection::Camera camera = someCamera();
    const glm::dvec3 beside = camera.target + 0.4 * projection::cameraFrame(camera).right;
    const projection::Camera parallel = withOtherProjection(camera);
    EXPECT_TRUE(parallel.orthographic());
    expectNear(seenAt(parallel, beside), seenAt(camera, beside));
    EXPECT_NEAR(glm::length(withOtherProjection(parallel).eye - camera.eye), 0, 1e-12);
}

TEST(CameraMoves, NumbersAreWrittenToTheBit) {
    projection::Camera camera = someCamera();
    camera.eye = {0.1, 1.0 / 3.0, 1e-17};
    OptionWords words;
    words.set("--view", "x");
    setCamera(words, camera);
    EXPECT_TRUE(hasCamera(words));
    EXPECT_FALSE(words.has("--view"));
    double x = 0, y = 0, z = 0;
    ASSERT_EQ(std::sscanf(words.valueOf("--eye").c_str(), "%lf,%lf,%lf", &x, &y, &z), 3);
    EXPECT_EQ(glm::dvec3(x, y, z), camera.eye);
}

TEST(TransferNodes, StayInOrderAndAreReadBackToTheBit) {
    preint::TransferFunction function = Standing().function();
    EXPECT_EQ(addNode(function, 1.0 / 3.0, 0.7), 1u);
    moveNode(function, 1, 5.0, 0.1);  // not past its neighbour
    EXPECT_EQ(function.extinction[1].scalar, 1.0);
    moveNode(function, 1, 1.0 / 3.0, 0.1);
    setColor(function, 0.5, {0.25, 0.5, 0.75});
    setColor(function, 0.5, {0.1, 0.2, 0.3});
    EXPECT_EQ(function.color.size(), 3u);
    addIsosurface(function, {0.6, 0.5, {1, 1, 1}});
    const preint::TransferFunction read = preint::parseTransferFunction(functionText(function), "test");
    ASSERT_EQ(read.extinction.size(), 3u);
    EXPECT_EQ(read.extinction[1].scalar, 1.0 / 3.0);
    EXPECT_EQ(read.extinction[1].extinction, 0.1);
    EXPECT_EQ(read.color[1].color, glm::dvec3(0.1, 0.2, 0.3));
    ASSERT_EQ(read.isosurfaces.size(), 1u);
    EXPECT_FALSE(read.normalized);
    EXPECT_THROW(addNode(function, 0, -1), std::runtime_error);
    EXPECT_THROW(moveNode(function, 9, 0, 1), std::runtime_error);
    EXPECT_THROW(setColor(function, 0, {2, 0, 0}), std::runtime_error);
}

TEST(ViewState, UndoesAGestureInOneStep) {
    OptionWords words;
    words.mesh = "bucky:8";
    ViewState state(words);
    Standing shown;
    EXPECT_TRUE(state.apply({"turn", "10", "0"}, shown));
    EXPECT_TRUE(state.apply({"turn", "10", "5"}, shown));  // the same drag
    state.mark();
    EXPECT_TRUE(state.apply({"set", "mode", "mip"}, shown));
    EXPECT_EQ(state.words().valueOf("--mode"), "mip");
    state.undo();
    EXPECT_TRUE(state.words().has("--eye"));
    EXPECT_FALSE(state.words().has("--mode"));
    state.undo();
    EXPECT_EQ(state.words(), words);
    EXPECT_FALSE(state.canUndo());
    state.redo();
    state.redo();
    EXPECT_EQ(state.words().valueOf("--mode"), "mip");
    EXPECT_FALSE(state.canRedo());
}

TEST(ViewState, RefusesWhatWillNotDoAndStaysAsItWas) {
    OptionWords words;
    words.mesh = "bucky:8";
    ViewState state(words);
    Standing shown;
    EXPECT_FALSE(state.apply({"dance"}, shown));
    const std::vector<std::vector<std::string>> refused{
        {"turn", "10"},  {"turn", "a", "b"}, {"turn", "1", "2", "3"}, {"zoom", "0"},        {"view", "behind"},
        {"recall", "9"}, {"step", "7"},      {"node", "0", "-1"},     {"window", "2", "1"}, {"turn", "nan", "0"}};
    for (const auto& command : refused) {
        EXPECT_THROW(state.apply(command, shown), std::runtime_error) << command.front();
        EXPECT_EQ(state.words(), words);
    }
}

TEST(ViewState, StoresViewsAndTakesSteps) {
    ViewState state{OptionWords()};
    Standing shown;
    state.apply({"store", "1"}, shown);
    shown.camera_.eye.x = 9;
    state.apply({"recall", "1"}, shown);
    EXPECT_EQ(state.words().valueOf("--eye"), "3,2,5");
    state.apply({"step", "1"}, shown);
    EXPECT_EQ(state.words().valueOf("--time"), "0.1");
    state.apply({"centre", "5", "5"}, shown);
    EXPECT_EQ(state.words().valueOf("--target"), "1,2,3");
    state.apply({"view", "x"}, shown);
    EXPECT_FALSE(state.words().has("--eye"));
    state.apply({"density", "2"}, shown);
    EXPECT_EQ(preint::parseTransferFunction(state.words().valueOf("--tf"), "tf").extinction[1].extinction, 4);
}

}  // namespace
