// SPDX-License-Identifier: Apache-2.0
/// \file
/// Small meshes and transfer functions whose picture is known, for tests of engines.
#pragma once

#include <functional>
#include <memory>
#include <random>
#include <vector>

#include <mesh/tet/procedural_field.h>
#include <mesh/tet/tet_mesh.h>
#include <preint/transfer_function.h>
#include <projection/core/camera.h>
#include <projection/core/scene.h>

namespace tetralux::test {

/// Fills in range and bounds.
inline mesh::ScalarMesh finished(mesh::ScalarMesh m) {
    m.bounds = mesh::usedBounds(m.positions, m.cells);
    m.scalarMin = 1e300;
    m.scalarMax = -1e300;
    for (mesh::CellIndex c = 0; c < m.cells.size(); ++c)
        for (int k = 0; k < 4; ++k) {
            m.scalarMin = std::min(m.scalarMin, m.scalarAt(c, k));
            m.scalarMax = std::max(m.scalarMax, m.scalarAt(c, k));
        }
    return m;
}

/// A field on n³ points and (n − 1)³·5 tetrahedra.
inline mesh::ScalarMesh sampledMesh(const mesh::ProceduralField& field, int n) {
    mesh::TetMesh sampled = mesh::sampleOnGrid(field, n);
    mesh::ScalarMesh m;
    m.positions = std::move(sampled.positions);
    m.cells = std::move(sampled.cells);
    m.scalars = std::move(sampled.fields.front().values);
    return finished(std::move(m));
}

/// The box [low, high] as n³ points and (n − 1)³·5 tetrahedra with the scalar given by `value`.
inline mesh::ScalarMesh boxMesh(int n, const std::function<double(const glm::dvec3&)>& value,
                                const glm::dvec3& low = glm::dvec3(0), const glm::dvec3& high = glm::dvec3(1)) {
    return sampledMesh({"box", "s", {low, high}, value, {}}, n);
}

/// The same with inner points moved by up to `share` of the spacing, scalars sampled at the moved points. Where it is
/// above 1/6, cells may fold, and what is covered twice counts twice.
inline mesh::ScalarMesh jitteredBoxMesh(int n, double share, unsigned seed,
                                        const std::function<double(const glm::dvec3&)>& value) {
    mesh::ScalarMesh m = boxMesh(n, value);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> offset(-share / (n - 1), share / (n - 1));
    for (std::size_t i = 0; i < m.positions.size(); ++i) {
        glm::dvec3& p = m.positions[i];
        for (int axis = 0; axis < 3; ++axis)
            if (p[axis] > 1e-9 && p[axis] < 1 - 1e-9) p[axis] += offset(random);
        m.scalars[i] = value(p);
    }
    return finished(std::move(m));
}

/// Keeps the cells for which `keep` holds at their centroid.
inline mesh::ScalarMesh carved(mesh::ScalarMesh m, const std::function<bool(const glm::dvec3&)>& keep) {
    std::vector<mesh::Tetrahedron> cells;
    for (const auto& cell : m.cells) {
        glm::dvec3 centroid(0);
        for (auto p : cell) centroid += 0.25 * m.positions[p];
        if (keep(centroid)) cells.push_back(cell);
    }
    m.cells = std::move(cells);
    return finished(std::move(m));
}

/// One tetrahedron with corners at the origin and the unit points of the axes, scalars as given.
inline mesh::ScalarMesh unitTetrahedron(const std::vector<double>& scalars) {
    mesh::ScalarMesh m;
    m.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    m.cells = {{0, 1, 2, 3}};
    m.scalars = scalars;
    return finished(std::move(m));
}

inline preint::TransferFunction constantFunction(double extinction, const glm::dvec3& color = {0.8, 0.5, 0.25}) {
    preint::TransferFunction f;
    f.color = {{0.0, color}};
    f.extinction = {{0.0, extinction}};
    return f;
}

/// Five nodes over [low, high], extinction up to `strongest`.
inline preint::TransferFunction smoothFunction(double low, double high, double strongest = 25.0) {
    auto at = [&](double t) { return low + t * (high - low); };
    preint::TransferFunction f;
    f.color = {{at(0.0), {0.1, 0.1, 0.6}},
               {at(0.25), {0.1, 0.7, 0.7}},
               {at(0.5), {0.2, 0.8, 0.2}},
               {at(0.75), {0.9, 0.8, 0.1}},
               {at(1.0), {0.9, 0.1, 0.1}}};
    f.extinction = {{at(0.0), 0.0},
                    {at(0.25), 0.08 * strongest},
                    {at(0.5), 0.2 * strongest},
                    {at(0.75), 0.5 * strongest},
                    {at(1.0), strongest}};
    return f;
}

/// Two isosurfaces in a thin mist.
inline preint::TransferFunction isosurfacesFunction(double low, double high) {
    auto at = [&](double t) { return low + t * (high - low); };
    preint::TransferFunction f;
    f.color = {{at(0.0), {0.3, 0.3, 0.3}}, {at(1.0), {0.7, 0.7, 0.7}}};
    f.extinction = {{at(0.0), 0.1}};
    f.isosurfaces = {{at(0.35), 0.4, {0.1, 0.4, 0.9}}, {at(0.65), 0.7, {0.9, 0.5, 0.1}}};
    return f;
}

inline projection::Scene sceneOf(mesh::ScalarMesh m, preint::TransferFunction function,
                                 projection::Mode mode = projection::Mode::Standard) {
    projection::Scene scene;
    scene.mesh = std::make_shared<const mesh::ScalarMesh>(std::move(m));
    scene.transferFunction = std::move(function);
    scene.settings.mode = mode;
    return scene;
}

inline projection::Camera cameraAt(const glm::dvec3& eye, const glm::dvec3& target = glm::dvec3(0.5), int width = 48,
                                   int height = 40) {
    projection::Camera camera;
    camera.eye = eye;
    camera.target = target;
    camera.width = width;
    camera.height = height;
    return camera;
}

/// Path of a ray inside a box at distances ≥ 0: [in, out], empty when out ≤ in.
inline std::pair<double, double> pathInBox(const projection::Ray& ray, const glm::dvec3& low, const glm::dvec3& high) {
    double in = 0, out = 1e300;
    for (int axis = 0; axis < 3; ++axis) {
        const double a = (low[axis] - ray.origin[axis]) / ray.direction[axis];
        const double b = (high[axis] - ray.origin[axis]) / ray.direction[axis];
        in = std::max(in, std::min(a, b));
        out = std::min(out, std::max(a, b));
    }
    return {in, out};
}

}  // namespace tetralux::test
