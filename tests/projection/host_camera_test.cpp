// SPDX-License-Identifier: Apache-2.0
// Cameras of a host's 4×4 matrices: off-centre, sheared and stretched, held against the matrix itself.
#include <tetralux/tetralux.h>

#include <array>
#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>
#include <glm/ext/matrix_clip_space.hpp>
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <projection/core/camera.h>
#include <projection/renderer/scene_settings.h>
#include <tests/support/analytic_scenes.h>

namespace tetralux {
namespace {

std::array<double, 16> rowsOf(const glm::dmat4& m) {
    std::array<double, 16> rows;
    for (int row = 0; row < 4; ++row)
        for (int column = 0; column < 4; ++column) rows[static_cast<std::size_t>(4 * row + column)] = m[column][row];
    return rows;
}

/// x and y move aside by `x` and `y` per depth, about a depth of `about`: what vtkCamera calls view shear.
glm::dmat4 viewShear(double x, double y, double about) {
    glm::dmat4 m(1);
    m[2] = {x, y, 1, 0};
    m[3] = {x * about, y * about, 0, 1};
    return m;
}

const glm::dmat4 worldToView = glm::lookAt(glm::dvec3(1.9, 1.4, 2.3), glm::dvec3(0.5), glm::dvec3(0, 1, 0));

struct HostView {
    const char* name;
    glm::dmat4 clipFromWorld;
};

std::vector<HostView> hostViews() {
    const glm::dmat4 centred = glm::perspective(0.5, 64.0 / 48, 0.1, 10.0);
    return {{"centred", centred * worldToView},
            {"off-centre", glm::frustum(-0.03, 0.02, -0.01, 0.025, 0.1, 10.0) * worldToView},
            {"stretched", glm::perspective(0.5, 0.7, 0.1, 10.0) * worldToView},
            {"view shear", centred * viewShear(0.1, -0.2, 2.6) * worldToView},
            {"sheared picture",
             glm::dmat4(1, 0, 0, 0, 0.3, 1.2, 0, 0, 0, 0, 1, 0, 0.1, 0.05, 0, 1) * centred * worldToView},
            {"rolled and stretched", glm::scale(glm::dmat4(1), glm::dvec3(1, 0.6, 1)) *
                                         glm::rotate(glm::dmat4(1), 0.5, glm::dvec3(0, 0, 1)) * centred * worldToView},
            {"parallel", glm::ortho(-0.8, 0.8, -0.6, 0.6, 0.1, 10.0) * worldToView},
            {"parallel off-centre", glm::ortho(-0.9, 0.6, -0.3, 0.7, 0.1, 10.0) * worldToView},
            {"oblique", glm::ortho(-0.9, 0.9, -0.8, 0.8, 0.1, 10.0) * viewShear(0.4, 0.3, 2.6) * worldToView}};
}

struct Picture {
    int width, height;
    std::vector<float> floats;

    Picture(int w, int h) : width(w), height(h), floats(static_cast<std::size_t>(4 * w * h)) {}
    ImageView view() { return {floats.data(), width, height, 0}; }
    const float* at(int x, int y) const { return floats.data() + 4 * (width * y + x); }
};

/// Largest difference of a channel between `part` and the part of `whole` that begins at (left, top).
double largestDifference(const Picture& part, const Picture& whole, int left = 0, int top = 0) {
    double largest = 0;
    for (int y = 0; y < part.height; ++y)
        for (int x = 0; x < part.width; ++x)
            for (int c = 0; c < 4; ++c)
                largest = std::max<double>(largest, std::abs(part.at(x, y)[c] - whole.at(left + x, top + y)[c]));
    return largest;
}

TransferFunction steep() {
    return TransferFunction::parse(
        R"({"color": [[0, 0, 0, 1], [1, 1, 0.5, 0]], "extinction": [[0, 0], [1, 30]],
            "isosurfaces": [{"value": 0.5, "opacity": 0.4, "color": [0, 1, 0]}]})");
}

Renderer rendererOf(const std::string& engine) {
    const mesh::ScalarMesh m = test::sampledMesh(mesh::proceduralField("bucky", 10), 10);
    std::vector<double> xyz;
    std::vector<std::uint32_t> cells;
    for (const glm::dvec3& p : m.positions) xyz.insert(xyz.end(), {p.x, p.y, p.z});
    for (const mesh::Tetrahedron& cell : m.cells) cells.insert(cells.end(), cell.begin(), cell.end());
    RendererOptions options;
    options.engine = engine;
    Renderer renderer(Mesh::fromTetrahedra(xyz, cells), options);
    const std::vector<double> values(m.scalars.begin(), m.scalars.end());
    renderer.setField(Field::onPoints(values));
    renderer.setTransferFunction(steep());
    return renderer;
}

std::vector<std::string> engineNames() {
    std::vector<std::string> names;
    for (const EngineInfo& engine : engines())
        if (engine.available) names.push_back(engine.name);
    return names;
}

TEST(HostCamera, RaysAreThoseOfTheMatrix) {
    constexpr int width = 64, height = 48;
    Picture picture(width, height);
    for (const HostView& view : hostViews()) {
        const glm::dmat4 worldFromClip = glm::inverse(view.clipFromWorld);
        const auto place = [&](double x, double y, double z) {
            const glm::dvec4 p =
                worldFromClip * glm::dvec4(2 * (x + 0.5) / width - 1, 1 - 2 * (y + 0.5) / height, z, 1);
            return glm::dvec3(p) / p.w;
        };
        const auto frame = projection::cameraFrame(
            renderer::sceneCamera(Camera::fromMatrix(rowsOf(view.clipFromWorld)), picture.view(), {}));
        for (const auto& [x, y] : {std::pair{0, 0}, {63, 0}, {0, 47}, {63, 47}, {20, 31}}) {
            const projection::Ray ray = projection::pixelRay(frame, x, y);
            for (const double z : {-0.8, 0.0, 0.9}) {
                const glm::dvec3 fromOrigin = place(x, y, z) - ray.origin;
                EXPECT_GT(glm::dot(fromOrigin, ray.direction), 0) << view.name;
                EXPECT_LT(glm::length(glm::cross(fromOrigin, ray.direction)), 1e-12)
                    << view.name << ' ' << x << ' ' << y;
            }
        }
    }
}

TEST(HostCamera, WhatLiesBeyondTheNearPlaneIsBeforeTheEyeOfParallelViews) {
    const glm::dmat4 clip = hostViews().back().clipFromWorld, world = glm::inverse(clip);
    Picture picture(8, 8);
    const auto frame =
        projection::cameraFrame(renderer::sceneCamera(Camera::fromMatrix(rowsOf(clip)), picture.view(), {}));
    double nearest = std::numeric_limits<double>::infinity();
    for (const double x : {-1.0, 1.0})
        for (const double y : {-1.0, 1.0})
            nearest =
                std::min(nearest, glm::dot(glm::dvec3(world * glm::dvec4(x, y, -1, 1)) - frame.eye, frame.forward));
    EXPECT_NEAR(nearest, 0, 1e-12);
}

TEST(HostCamera, EnginesAgreeOnWhatMatricesShow) {
    std::map<std::string, Renderer> renderers;
    for (const std::string& name : engineNames()) renderers.emplace(name, rendererOf(name));
    const auto agree = [&](const std::string& what) {
        for (const HostView& view : hostViews()) {
            const Camera camera = Camera::fromMatrix(rowsOf(view.clipFromWorld));
            Picture exact(64, 48);
            renderers.at("reference").render(camera, exact.view());
            float shown = 0;
            for (int y = 0; y < 48; ++y)
                for (int x = 0; x < 64; ++x) shown = std::max(shown, exact.at(x, y)[3]);
            EXPECT_GT(shown, 0.3f) << view.name;
            for (auto& [name, renderer] : renderers) {
                if (name == "reference") continue;
                Picture picture(64, 48);
                renderer.render(camera, picture.view());
                // tables of gl are made for 2e-4; cpu is within rounding
                EXPECT_LT(largestDifference(picture, exact), name == "gl" ? 1e-3 : 5e-5)
                    << name << ' ' << view.name << ' ' << what;
                EXPECT_LT(renderer.verify(camera, picture.view(), 300).rmse, name == "gl" ? 1e-4 : 5e-6)
                    << name << ' ' << view.name << ' ' << what;
            }
        }
    };
    const auto forAll = [&](const auto& set) {
        for (auto& [name, renderer] : renderers) set(renderer);
    };
    agree("plain");
    forAll([](Renderer& r) { r.setSilhouettes(Silhouettes::Exact); });
    agree("silhouettes");
    forAll([](Renderer& r) {
        r.setSilhouettes(Silhouettes::None);
        r.setLighting(
            R"({"lights": [{"type": "directional", "towards": [1, 2, 3]}, {"type": "point", "position": [2, 0, 1]},
                                    {"type": "head"}]})");
    });
    agree("lights");
    forAll([](Renderer& r) {
        r.setLighting(Lighting{});
        r.setMode(Mode::Depth);
    });
    agree("depth");
}

TEST(HostCamera, TilesByOffCentreMatricesArePartsOfTheWholePicture) {
    constexpr int width = 64, height = 48, left = 24, top = 12, partWidth = 32, partHeight = 24;
    // the tile's own picture spans −1 … 1
    const glm::dvec2 scale(double{width} / partWidth, double{height} / partHeight);
    const glm::dvec2 middle(2.0 * (left + 0.5 * partWidth) / width - 1, 1 - 2.0 * (top + 0.5 * partHeight) / height);
    const glm::dmat4 tile =
        glm::scale(glm::dmat4(1), glm::dvec3(scale, 1)) * glm::translate(glm::dmat4(1), glm::dvec3(-middle, 0));
    for (const std::string& engine : engineNames()) {
        Renderer renderer = rendererOf(engine);
        for (const HostView& view : hostViews()) {
            const Camera camera = Camera::fromMatrix(rowsOf(view.clipFromWorld));
            Picture whole(width, height), part(partWidth, partHeight);
            renderer.render(camera, whole.view());
            renderer.render(Camera::fromMatrix(rowsOf(tile * view.clipFromWorld)), part.view());
            EXPECT_LT(largestDifference(part, whole, left, top), 5e-5) << engine << ' ' << view.name;
            Control control;
            control.tile = {left, top, width, height};
            renderer.render(camera, part.view(), control);
            EXPECT_LT(largestDifference(part, whole, left, top), 5e-5) << engine << ' ' << view.name;
        }
    }
}

TEST(HostCamera, TilesWithSamplesArePartsOfTheWholePicture) {
    Renderer renderer = rendererOf("cpu");
    renderer.setSamples(4);
    const Camera camera = Camera::fromMatrix(rowsOf(hostViews()[4].clipFromWorld));
    Picture whole(64, 48), part(32, 24);
    renderer.render(camera, whole.view());
    Control control;
    control.tile = {24, 12, 64, 48};
    renderer.render(camera, part.view(), control);
    EXPECT_LT(largestDifference(part, whole, 24, 12), 5e-5);
}

TEST(HostCamera, StretchedPixelsAreEveryThirdOfSquareOnes) {
    Renderer renderer = rendererOf("cpu");
    Camera camera{{1.9, 1.4, 2.3}, {0.5, 0.5, 0.5}};
    std::vector<float> limits(static_cast<std::size_t>(96 * 48), 2.6f);
    for (const double parallelHeight : {0.0, 1.3}) {
        camera.orthographicHeight = parallelHeight;
        camera.aspect = 0;
        Control control;
        control.depthLimit = limits.data();
        Picture square(96, 48), stretched(32, 48);
        renderer.render(camera, square.view(), control);
        camera.aspect = 2;
        renderer.render(camera, stretched.view(), control);
        for (int y = 0; y < 48; ++y)
            for (int x = 0; x < 32; ++x)
                for (int c = 0; c < 4; ++c)
                    EXPECT_NEAR(stretched.at(x, y)[c], square.at(3 * x + 1, y)[c], 5e-5) << x << ' ' << y;
    }
}

TEST(HostCamera, ProbesLieInTheirPixel) {
    Renderer renderer = rendererOf("cpu");
    for (const HostView& view : hostViews()) {
        const Camera camera = Camera::fromMatrix(rowsOf(view.clipFromWorld));
        Picture picture(64, 48);
        renderer.render(camera, picture.view());
        const PixelProbe probe = renderer.probe(camera, 30, 25);
        ASSERT_TRUE(probe.hit) << view.name;
        const glm::dvec4 clip =
            view.clipFromWorld * glm::dvec4(probe.position[0], probe.position[1], probe.position[2], 1);
        EXPECT_NEAR(clip.x / clip.w, 2 * 30.5 / 64 - 1, 1e-9) << view.name;
        EXPECT_NEAR(clip.y / clip.w, 1 - 2 * 25.5 / 48, 1e-9) << view.name;
    }
}

TEST(HostCamera, RefusesMatricesThatMakeNoPicture) {
    const auto refused = [](const glm::dmat4& m, const char* word) {
        try {
            Camera::fromMatrix(rowsOf(m));
            ADD_FAILURE() << "accepted: " << word;
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), Errc::BadInput);
            EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << error.what();
        }
    };
    for (const HostView& view : hostViews()) {
        refused(glm::scale(glm::dmat4(1), glm::dvec3(1, -1, 1)) * view.clipFromWorld, "mirrors");
        refused(glm::scale(glm::dmat4(1), glm::dvec3(0, 1, 1)) * view.clipFromWorld, "singular");
    }
    glm::dmat4 bad = hostViews()[0].clipFromWorld;
    bad[2][1] = std::nan("");
    refused(bad, "not finite");
    refused(glm::dmat4(0), "");
    Renderer renderer = rendererOf("cpu");
    Picture picture(8, 8);
    Camera camera;
    camera.aspect = -1;
    EXPECT_THROW(renderer.render(camera, picture.view()), Error);
    camera.aspect = 0;
    camera.shear = std::nan("");
    EXPECT_THROW(renderer.render(camera, picture.view()), Error);
}

}  // namespace
}  // namespace tetralux
