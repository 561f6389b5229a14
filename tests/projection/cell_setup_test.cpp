// SPDX-License-Identifier: Apache-2.0
// Projected cells (affine planes in float) against the reference's ray–cell cut (side-of-edge products in double).
#include <cmath>
#include <limits>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include <mesh/tet/adjacency.h>
#include <projection/cells/cell_interval.h>
#include <projection/cells/cell_setup.h>
#include <projection/reference/reference_ray_caster.h>
#include <tests/support/analytic_scenes.h>

namespace tetralux::projection {
namespace {

using namespace tetralux::test;

struct Interval {
    bool hit = false;
    double length = 0, scalarIn = 0, scalarOut = 0;  // scene units
};

/// What an engine does with a record at one pixel.
Interval evaluate(const CellRecord& r, const CameraFrame& frame, int x, int y) {
    const double dx = x - double(r.pixelX) - r.fractionX, dy = y - double(r.pixelY) - r.fractionY;
    double in = frame.orthographic ? std::copysign(1.0, r.scale) : inverseDepthAtEye,
           out = frame.orthographic ? -1e30 : -1.0;
    for (int k = 0; k < 4; ++k) {
        const double inverseDepth = glsl::planeInverseDepth(r.plane[k][0], r.plane[k][1], r.plane[k][2], dx, dy);
        if (static_cast<int>(r.frontMask) >> k & 1)
            in = std::min(in, inverseDepth);
        else
            out = std::max(out, inverseDepth);
    }
    if (!(in > out)) return {};
    if (frame.orthographic)
        return {true, glsl::segmentLengthOrthographic(r.scale, in, out),
                glsl::scalarOrthographic(r.scalar, r.scalarPerX, r.scalarPerY, r.scalarPerInverseDepth, dx, dy, in,
                                         r.scalarLow, r.scalarHigh),
                glsl::scalarOrthographic(r.scalar, r.scalarPerX, r.scalarPerY, r.scalarPerInverseDepth, dx, dy, out,
                                         r.scalarLow, r.scalarHigh)};
    const glm::dvec3 offset = (x - frame.centre.x) * frame.perPixelRight + (y - frame.centre.y) * frame.perPixelDown;
    return {true, glsl::segmentLengthPerspective(r.scale, in, out, glm::length(frame.forward + offset)),
            glsl::scalarPerspective(r.scalar, r.scalarPerX, r.scalarPerY, r.scalarPerInverseDepth, dx, dy, in,
                                    r.scalarLow, r.scalarHigh),
            glsl::scalarPerspective(r.scalar, r.scalarPerX, r.scalarPerY, r.scalarPerInverseDepth, dx, dy, out,
                                    r.scalarLow, r.scalarHigh)};
}

struct Worst {
    double length = 0, scalar = 0;  // lengths relative to the mesh's diagonal
    int compared = 0;
};

/// All cells at some pixels, record against reference.
Worst compare(const Scene& scene, const Camera& camera, int stride) {
    const mesh::ScalarMesh& m = *scene.mesh;
    const SceneUnits units = sceneUnits(m);
    const CameraFrame frame = cameraFrame(camera);
    const CellProjector projector(m, units, frame);
    const ReferenceRayCaster caster(scene);
    Worst worst;
    for (int y = 0; y < camera.height; y += stride)
        for (int x = 0; x < camera.width; x += stride) {
            std::vector<const RaySegment*> byCell(m.cells.size());
            const auto segments = caster.segmentsAt(camera, x + frame.sampleShift.x, y + frame.sampleShift.y);
            for (const auto& segment : segments) byCell[segment.cell] = &segment;
            for (mesh::CellIndex c = 0; c < m.cells.size(); ++c) {
                PixelRect rect;
                Interval found;
                if (projector.bounds(c, rect) == SkipReason::None && x >= rect.x0 && x < rect.x1 && y >= rect.y0 &&
                    y < rect.y1)
                    found = evaluate(projector.record(c), frame, x, y);
                const double expected = byCell[c] ? (byCell[c]->tOut - byCell[c]->tIn) / units.length : 0.0;
                worst.length = std::max(worst.length, std::abs(found.length - expected));
                if (byCell[c] && found.hit) {
                    ++worst.compared;
                    worst.scalar = std::max({worst.scalar, std::abs(found.scalarIn - units.toUnit(byCell[c]->scalarIn)),
                                             std::abs(found.scalarOut - units.toUnit(byCell[c]->scalarOut))});
                }
            }
        }
    return worst;
}

double wave(const glm::dvec3& p) {
    return std::sin(3 * p.x) + p.y * p.z;
}

// Thresholds: float's 6e-8 times the slope of the steepest faces, which a jitter of 0.2 brings to some 10.
TEST(CellSetup, RecordsAgreeWithTheReference) {
    const Scene scene = sceneOf(jitteredBoxMesh(5, 0.2, 3, wave), constantFunction(1));
    for (const glm::dvec3& eye : {glm::dvec3(1.9, 1.4, 2.3), glm::dvec3(0.45, 0.52, 0.61), glm::dvec3(0.5, 0.5, 2.0)}) {
        const Worst worst = compare(scene, cameraAt(eye, {0.7, 0.4, 0.3}), 3);
        EXPECT_GT(worst.compared, 300);
        EXPECT_LT(worst.length, 2e-6) << eye.x;
        EXPECT_LT(worst.scalar, 2e-6) << eye.x;
    }
}

TEST(CellSetup, EyeOnAVertexAnEdgeAFaceOfTheMesh) {
    const Scene scene = sceneOf(boxMesh(5, wave), constantFunction(1));
    for (const glm::dvec3& eye : {glm::dvec3(0.25, 0.5, 0.5), glm::dvec3(0.3, 0.5, 0.5), glm::dvec3(0.3, 0.55, 0.5),
                                  glm::dvec3(0, 0, 0), glm::dvec3(0.5, 0.5, 1)}) {
        const Worst worst =
            compare(scene, cameraAt(eye, eye == glm::dvec3(0) ? glm::dvec3(0.5) : glm::dvec3(1, 0.6, 0.5)), 3);
        EXPECT_GT(worst.compared, 300);
        EXPECT_LT(worst.length, 2e-6) << eye.x << ' ' << eye.y << ' ' << eye.z;
        EXPECT_LT(worst.scalar, 2e-6) << eye.x << ' ' << eye.y << ' ' << eye.z;
    }
}

TEST(CellSetup, OrthographicRecordsAgreeWithTheReference) {
    const Scene scene = sceneOf(jitteredBoxMesh(5, 0.2, 3, wave), constantFunction(1));
    for (double distance : {2.0, 0.1}) {  // 0.1: the eye's plane cuts the mesh
        Camera camera = cameraAt(glm::dvec3(0.5) + distance * glm::dvec3(0.6, 0.4, 0.7));
        camera.orthographicHeight = 1.9;
        const Worst worst = compare(scene, camera, 3);
        EXPECT_GT(worst.compared, 300);
        EXPECT_LT(worst.length, 2e-6);
        EXPECT_LT(worst.scalar, 2e-6);
    }
}

TEST(CellSetup, SizeAndOffsetOfTheMeshDoNotMatter) {
    const mesh::ScalarMesh base = jitteredBoxMesh(4, 0.2, 3, wave);
    for (double scale : {1e-12, 1e12})
        for (double offset : {0.0, 1e6}) {
            mesh::ScalarMesh moved = base;
            const glm::dvec3 shift = scale * offset * glm::dvec3(1, -0.5, 0.25);
            for (auto& p : moved.positions) p = p * scale + shift;
            moved = finished(std::move(moved));
            const Worst worst =
                compare(sceneOf(moved, constantFunction(1 / scale)),
                        cameraAt(glm::dvec3(1.9, 1.4, 2.3) * scale + shift, glm::dvec3(0.5) * scale + shift), 4);
            EXPECT_GT(worst.compared, 50);
            EXPECT_LT(worst.length, 2e-6) << scale << ' ' << offset;
            EXPECT_LT(worst.scalar, 2e-6) << scale << ' ' << offset;
        }
}

TEST(CellSetup, NeighboursDisagreeAboutTheSideOfTheirFace) {
    const mesh::ScalarMesh m = jitteredBoxMesh(5, 0.3, 11, wave);
    const auto adjacency = mesh::buildAdjacency(m.cells, m.positions.size());
    const CellProjector projector(m, sceneUnits(m), cameraFrame(cameraAt({0.3, 0.4, 0.6}, {0.9, 0.4, 0.3})));
    int checked = 0;
    for (mesh::CellIndex c = 0; c < m.cells.size(); ++c)
        for (int k = 0; k < 4; ++k) {
            const mesh::CellIndex other = adjacency.neighbours[c][static_cast<std::size_t>(k)];
            if (other == mesh::Adjacency::noNeighbour) continue;
            for (int j = 0; j < 4; ++j)
                if (adjacency.neighbours[other][static_cast<std::size_t>(j)] == c) {
                    EXPECT_NE(projector.faceIsFront(c, k), projector.faceIsFront(other, j));
                    ++checked;
                }
        }
    EXPECT_GT(checked, 1000);
}

TEST(CellSetup, EyeCoordinatesAreBarycentric) {
    const mesh::ScalarMesh m = unitTetrahedron({0, 1, 2, 3});
    const CellProjector projector(m, sceneUnits(m), cameraFrame(cameraAt({2, 3, 4}, glm::dvec3(0.25))));
    const auto lambda = projector.eyeCoordinates(0);
    EXPECT_NEAR(lambda[1], 2, 1e-12);
    EXPECT_NEAR(lambda[2], 3, 1e-12);
    EXPECT_NEAR(lambda[3], 4, 1e-12);
    EXPECT_NEAR(lambda[0], 1 - 9, 1e-12);
}

TEST(CellSetup, TransferFunctionInSceneUnitsGivesTheSameDepth) {
    mesh::ScalarMesh m = unitTetrahedron({10, 12, 14, 16});
    const SceneUnits units = sceneUnits(m);
    const auto f = smoothFunction(10, 16);
    const auto standard = inSceneUnits(f, units, preint::Integral::Standard);
    const auto invariant = inSceneUnits(f, units, preint::Integral::ScaleInvariant);
    EXPECT_NEAR(standard.extinctionAt(units.toUnit(13)) * (0.3 / units.length), f.extinctionAt(13) * 0.3, 1e-12);
    EXPECT_NEAR(invariant.extinctionAt(units.toUnit(13)) * (units.toUnit(13.5) - units.toUnit(13)),
                f.extinctionAt(13) * 0.5, 1e-12);
}

}  // namespace
}  // namespace tetralux::projection
