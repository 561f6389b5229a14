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

#include <mesh/tet/tet_mesh.h>
#include <shading/ball_cubes.h>

namespace tetralux::shading {

/// Barycentric coordinates of `count` points that fill a tetrahedron evenly: the additive sequence of Roberts, whose
/// three numbers in ascending order cut [0, 1] into four parts.
std::vector<std::array<double, 4>> fillingPoints(int count);

/// Sums over points of weight w with offset (x, y, z) from a centre, both pure numbers.
struct PointMoments {
    double weight = 0, squares = 0;                         ///< Σ w, Σ w²
    double xx = 0, yy = 0, zz = 0, xy = 0, xz = 0, yz = 0;  ///< Σ w·x·x …
};

/// How a level set bends away from its tangent plane: z = ½(xx·x² + 2·xy·xy + yy·y²), lengths in radii.
struct Bend {
    double xx = 0, yy = 0, xy = 0;
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

    /// Fitted (least squares) to the points of near() in every second cube whose scalar is within a quarter of the
    /// interval. `frame`: unit vectors x, y in the tangent plane and z along the gradient, along which the scalar rises
    /// by `slope` intervals per radius.
    Bend bendNear(const glm::dvec3& centre, double scalar, const std::array<glm::dvec3, 3>& frame, double slope) const;

private:
    struct Run;

    template <bool EverySecond, class Use>
    void forRuns(const glm::dvec3& centre, double scalar, float interval, const Use& use) const;
    PointMoments nearHere(const glm::dvec3& centre, double scalar) const;
    PointMoments nearWide(const glm::dvec3& centre, double scalar) const;
    Bend bendHere(const glm::dvec3& centre, double scalar, const std::array<glm::dvec3, 3>& frame, double slope) const;
    Bend bendWide(const glm::dvec3& centre, double scalar, const std::array<glm::dvec3, 3>& frame, double slope) const;
    void layPoints(const mesh::ScalarMesh& mesh, int pointsPerCell);

    /// Points of a cube are looked up and summed by blocks of this many; 0 areas fill the last.
    static constexpr std::size_t blockSize = 8;

    const BallCubes cubes_;
    const double perRadius_, perInterval_;
    double scalarOrigin_ = 0.0;        ///< what float scalars count from
    std::vector<std::size_t> starts_;  ///< per cube its first block, and the end
    std::vector<float> heads_;         ///< per block its first scalar
    std::vector<float> x_, y_, z_;     ///< from the low corner of the cube, in radii
    std::vector<float> scalars_;       ///< from scalarOrigin_, in intervals
    std::vector<float> areas_;         ///< |∇s|·dV
};

}  // namespace tetralux::shading
