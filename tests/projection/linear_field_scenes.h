// SPDX-License-Identifier: Apache-2.0
/// \file
/// A field that is linear in the unit cube, on cells of every type: whatever the cells, straight or bent, the picture
/// is that of the cube.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include <mesh/soup/validation.h>
#include <mesh/tet/select_scalar.h>
#include <projection/reference/reference_ray_caster.h>
#include <tests/mesh/cube_cells.h>
#include <tests/support/analytic_scenes.h>

namespace tetralux::test {

struct LinearFieldCase {
    std::string name;
    mesh::CellSoup soup;
};

/// Less than `mesh::test::bend`, so that cells of few cubes do not fold.
inline glm::dvec3 bendALittle(const glm::dvec3& x) {
    return x + 0.35 * (mesh::test::bend(x) - x);
}

inline std::vector<LinearFieldCase> linearFieldCases() {
    using namespace mesh::test;
    std::vector<LinearFieldCase> cases;
    for (const CellKind& kind : linearCellKinds) {
        cases.push_back({kind.name, cubeGrid(3, 7, straight, kind.add)});
        cases.push_back({std::string(kind.name) + "_warped", cubeGrid(3, 7, bendALittle, kind.add)});
    }
    for (const CurvedKind& kind : curvedCellKinds) {
        cases.push_back({kind.name, curvedGrid(2, kind, straight)});
        cases.push_back({std::string(kind.name) + "_warped", curvedGrid(2, kind, bendALittle)});
    }
    for (LinearFieldCase& each : cases) addPointField(each.soup, "s", linearField);
    return cases;
}

/// The case as it is drawn. \throws std::runtime_error if checking finds anything.
inline projection::Scene linearFieldScene(const mesh::CellSoup& soup) {
    mesh::ReadResult read = mesh::tetMeshFromSoup(soup);
    if (!read.report.defects.empty()) throw std::runtime_error(mesh::defectName(read.report.defects.begin()->first));
    mesh::ScalarMesh cells = mesh::selectScalar(std::move(read.mesh), "s", read.report).mesh;
    // The range of the whole cube, which rounding could move for the picture at hand.
    return sceneOf(std::move(cells), smoothFunction(-0.6, 2.4, 6.0));
}

/// The same domain in plain tetrahedra.
inline projection::Scene plainLinearScene() {
    return sceneOf(boxMesh(4, mesh::test::linearField), smoothFunction(-0.6, 2.4, 6.0));
}

inline projection::Camera linearFieldCamera() {
    return cameraAt({2.1, 1.6, 2.7}, {0.5, 0.5, 0.5}, 56, 48);
}

inline projection::Image referenceOf(const projection::Scene& scene) {
    projection::RayCastCounts counts;
    return projection::ReferenceRayCaster(scene).render(linearFieldCamera(), counts);
}

}  // namespace tetralux::test
