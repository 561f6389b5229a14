// SPDX-License-Identifier: Apache-2.0
/// \file
/// Scenes at random where floats have least room: scalars over many decades, cells of any flatness, transfer functions
/// with nodes and isosurfaces at the field's own values, eyes upon faces, edges and corners, and far away.
#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <string>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <projection/core/clip_region.h>
#include <tests/support/analytic_scenes.h>

namespace tetralux::test {

struct RandomScene {
    projection::Scene scene;
    projection::Camera camera;
    std::string what;
};

class RandomNumerics {
    double share() { return std::uniform_real_distribution<double>(0, 1)(random_); }
    int below(int count) { return std::uniform_int_distribution<int>(0, count - 1)(random_); }
    bool oneIn(int count) { return below(count) == 0; }
    template <class Items>
    auto pick(const Items& items) {
        return items[static_cast<std::size_t>(below(static_cast<int>(std::size(items))))];
    }

public:
    explicit RandomNumerics(unsigned seed) : random_(seed) {}

    RandomScene scene() {
        RandomScene made;
        const glm::dvec3 size = sizes();
        mesh::ScalarMesh m = mesh(size);
        setField(m);
        m = finished(std::move(m));
        const projection::Mode mode = pick(modes);
        made.scene = sceneOf(m, function(m, mode), mode);
        made.camera = camera(*made.scene.mesh);
        setOptions(made.scene);
        made.what =
            fmt::format("{} mode {} size {:.0e}", what_, static_cast<int>(mode), std::min({size.x, size.y, size.z}));
        return made;
    }

private:
    using Mode = projection::Mode;
    static constexpr Mode modes[] = {Mode::Standard, Mode::Standard,   Mode::ScaleInvariant, Mode::Mip,
                                     Mode::Minimum,  Mode::Average,    Mode::Additive,       Mode::DataAdditive,
                                     Mode::Emission, Mode::Absorption, Mode::FirstHit,       Mode::Depth};

    void note(const std::string& text) { what_ += (what_.empty() ? "" : ", ") + text; }

    glm::dvec3 sizes() {
        glm::dvec3 size(1);
        if (oneIn(4)) size[below(3)] = std::pow(10.0, -5 * share());
        return size;
    }

    /// A grid whose inner points are moved, all of them or none; its boundary stays flat.
    mesh::ScalarMesh mesh(const glm::dvec3& size) {
        const int points = 3 + below(2);
        const double jitter = oneIn(2) ? 0.0 : 0.45 * share();
        mesh::ScalarMesh m = jitteredBoxMesh(points, jitter, static_cast<unsigned>(below(1 << 30)),
                                             [](const glm::dvec3&) { return 0.0; });
        for (glm::dvec3& p : m.positions) p = size * p;
        note(fmt::format("{} points{}", points, jitter > 0 ? " jittered" : ""));
        return m;
    }

    void setField(mesh::ScalarMesh& m) {
        const bool cells = oneIn(4);
        if (cells) m.association = mesh::Association::Cell;
        m.scalars.resize(cells ? m.cells.size() : m.positions.size());
        const int kind = below(6);
        const double decades = 2 + 12 * share(), offset = pick(std::array{0.5, -1.0, 1e3, 1e-3});
        static constexpr const char* names[] = {"decades", "decades beside an offset", "labels", "plateaus", "plain",
                                                "wide"};
        for (double& s : m.scalars) {
            switch (kind) {
                case 0:
                    s = std::pow(10.0, -decades * share());
                    break;
                case 1:
                    s = offset + std::pow(10.0, -decades * share());
                    break;
                case 2:
                    s = below(5) / 3.0;
                    break;
                case 3:
                    s = std::clamp(2 * share() - 0.5, 0.0, 1.0);
                    break;
                case 4:
                    s = share();
                    break;
                default:
                    s = std::pow(10.0, -30 + 60 * share());
                    break;
            }
        }
        note(fmt::format("{}{}", names[kind], cells ? " of cells" : ""));
    }

    /// A node at a value of the field, or between, or anywhere near.
    double nodeScalar(const mesh::ScalarMesh& m) {
        const double own = pick(m.scalars);
        return oneIn(2) ? own : std::lerp(own, pick(m.scalars), share());
    }

    preint::TransferFunction function(const mesh::ScalarMesh& m, Mode mode) {
        preint::TransferFunction f;
        const double range = std::max(m.scalarMax - m.scalarMin, 1e-300);
        const double extent = projection::integralOf(mode) == preint::Integral::ScaleInvariant ? range : thinnest(m);
        std::vector<double> scalars;
        for (int i = 2 + below(4); i > 0; --i) scalars.push_back(nodeScalar(m));
        std::sort(scalars.begin(), scalars.end());
        for (const double s : scalars) {
            const auto add = [&] {
                f.color.push_back({s, {share(), share(), share()}});
                f.extinction.push_back({s, oneIn(3) ? 0.0 : 4 * share() / extent});
            };
            if (!f.color.empty() && f.color.back().scalar == s) continue;
            add();
            if (oneIn(4)) add();  // a jump
        }
        if (oneIn(3)) f.isosurfaces.push_back({nodeScalar(m), 0.2 + 0.7 * share(), {share(), share(), share()}});
        return f;
    }

    static double thinnest(const mesh::ScalarMesh& m) {
        const glm::dvec3 size = m.bounds.high - m.bounds.low;
        return std::min({size.x, size.y, size.z});
    }

    projection::Camera camera(const mesh::ScalarMesh& m) {
        const glm::dvec3 low = m.bounds.low, high = m.bounds.high, centre = m.bounds.centre();
        const double length = m.bounds.diagonal();
        glm::dvec3 eye, target = centre, direction(0.3 + share(), 0.2 + share(), -0.5 + share());
        direction = glm::normalize(direction);
        const int kind = below(7);
        static constexpr const char* names[] = {"eye anywhere",    "eye along an edge",   "eye in a face's plane",
                                                "eye on a corner", "eye beside a corner", "eye far away",
                                                "along an axis"};
        double distance = 1.5 + 2 * share();
        eye = centre + length * distance * direction;
        double reach = length;
        switch (kind) {
            case 1: {  // the line of an edge of the grid or its boundary
                const int axis = below(3);
                eye = pick(m.positions);
                target = eye;
                eye[axis] = low[axis] - length * distance;
                target[axis] = centre[axis];
                break;
            }
            case 2: {
                const int axis = below(3);
                eye[axis] = target[axis] = oneIn(2) ? low[axis] : pick(m.positions)[axis];
                break;
            }
            case 3:
            case 4:
                eye = glm::dvec3(oneIn(2) ? low.x : high.x, oneIn(2) ? low.y : high.y, oneIn(2) ? low.z : high.z);
                if (oneIn(3)) eye = pick(m.positions);
                if (kind == 4) eye += length * std::pow(10.0, -9 + 6 * share()) * direction;
                target = eye + direction;
                break;
            case 5:
                reach = length * std::pow(10.0, 1 + 6 * share());
                eye = centre + reach * direction;
                break;
            case 6:
                eye = centre;
                eye[below(3)] += length * distance;
                break;
            default:
                break;
        }
        projection::Camera camera = cameraAt(eye, target, 24 - below(2), 24 - below(2));
        const glm::dvec3 forward = glm::normalize(target - eye);
        camera.up = std::abs(forward.y) > 0.9 ? glm::dvec3(0, 0, 1) : glm::dvec3(0, 1, 0);
        if (kind == 5)
            camera.fovDegrees = 2 * std::atan(0.6 * length / reach) * 180 / 3.14159265358979;
        else if (kind != 3 && kind != 4 && oneIn(4))
            camera.orthographicHeight = length * (0.3 + share());
        else
            camera.fovDegrees = kind == 3 || kind == 4 ? 70 : 20 + 20 * share();
        note(names[kind]);
        return camera;
    }

    void setOptions(projection::Scene& scene) {
        const Mode mode = scene.settings.mode;
        const bool shades = mode == Mode::Standard || mode == Mode::ScaleInvariant || projection::addsUp(mode);
        auto& shading = scene.settings.shading;
        if (oneIn(4)) {
            const glm::dvec3 size = scene.mesh->bounds.high - scene.mesh->bounds.low;
            glm::dvec3 normal(0);
            normal[below(3)] = oneIn(2) ? 1 : -1;
            if (oneIn(2)) normal = glm::dvec3(share() - 0.5, share() - 0.5, share() - 0.5);
            scene.mapSources.push_back(std::make_shared<projection::ClipRegion>(
                std::vector<projection::HalfSpace>{{scene.mesh->bounds.low + size * (0.25 + 0.5 * share()), normal}},
                0.0));
            note("clip plane");
        }
        if (shades && oneIn(4)) {
            shading.silhouette = true;
            shading.approximateSilhouette = oneIn(2);
            note("silhouettes");
        }
        if (shades && oneIn(5)) {
            shading.lights.push_back({glm::dvec3(0.3, 0.5, 0.8)});
            note("light");
        }
        if (shades && oneIn(6)) {
            shading.depthColor = shading::DepthColor{{0.1, 0.2, 0.9}, 0.8};
            note("depth colour");
        }
    }

    std::mt19937 random_;
    std::string what_;
};

}  // namespace tetralux::test
