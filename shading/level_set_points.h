// SPDX-License-Identifier: Apache-2.0
/// \file
/// Internal: points that stand for the cells of a mesh, so ordered that those of nearly the same scalar near a place
/// are few runs of memory.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <vector>

#include <glm/vec3.hpp>

#include <mesh/tet_mesh.h>

namespace tetralux::shading {

/// Barycentric coordinates of `count` points that fill a tetrahedron evenly: the additive sequence of Roberts, whose
/// three numbers in ascending order cut [0, 1] into four parts.
std::vector<std::array<double, 4>> fillingPoints(int count);

/// Sums over points of weight w with offset (x, y, z) from a centre, both pure numbers.
struct PointMoments {
    double weight = 0;                                      ///< Σ w
    double xx = 0, yy = 0, zz = 0, xy = 0, xz = 0, yz = 0;  ///< Σ w·x·x …
};

/// Every cell's filling points, in cubes of half a radius or more, in each cube by scalar.
class LevelSetPoints {
public:
    /// `radius` in mesh units, `interval` in those of the scalar, both > 0; at least one cell.
    LevelSetPoints(const mesh::ScalarMesh& mesh, double radius, double interval, int pointsPerCell);

    /// Points x within the radius of `centre` whose scalar is within the interval of `scalar`, offsets in radii, with w
    /// = (1 − |x − centre|²/r²)(1 − (s(x) − scalar)²/ε²)·|∇s|·dV, the last in units that are the same for all. In float
    /// but for the last sums: moments hold to some 1e-6 of their trace.
    PointMoments near(const glm::dvec3& centre, double scalar) const;

private:
    using Place = std::array<std::size_t, 3>;

    void layCubes(const mesh::ScalarMesh& mesh);
    std::size_t cubeOf(const Place& place) const { return (place[2] * counts_[1] + place[1]) * counts_[0] + place[0]; }
    Place placeOf(const glm::dvec3& fromOrigin) const;
    void addCube(std::size_t cube, const glm::dvec3& centreFromCube, float scalar, PointMoments& sums) const;

    const double perRadius_, perInterval_;
    glm::dvec3 origin_{0};       ///< low corner of the first cube, mesh units
    double scalarOrigin_ = 0.0;  ///< what float scalars count from
    double side_ = 0.5;          ///< of a cube, in radii
    Place counts_{1, 1, 1};
    std::vector<std::size_t> starts_;  ///< per cube its first point, and the end
    std::vector<float> x_, y_, z_;     ///< from the low corner of the cube, in radii
    std::vector<float> scalars_;       ///< from scalarOrigin_, in intervals
    std::vector<float> areas_;         ///< |∇s|·dV
};

}  // namespace tetralux::shading
