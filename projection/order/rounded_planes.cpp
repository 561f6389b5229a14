// SPDX-License-Identifier: Apache-2.0
#include <projection/order/rounded_planes.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace tetralux::projection {

namespace {

constexpr double steps = 32767;  // per unit

/// Triangles whose area is less than this of their longest edge (both in mesh diagonals) have no certain plane:
/// positions are rounded to 1e-16, normals of others are right to 1e-7.
constexpr double leastHeight = 1e-8;

/// Half a step for rounding to steps; the rest is for normals and for sums in float, both below 1e-6.
constexpr double errorSteps = 0.6;

/// Inner side positive; all 0, which is certain of nothing, for a triangle without a certain plane. Taken in the order
/// of the point numbers, so that both cells of a face round alike.
glm::dvec4 planeOf(const std::array<mesh::PointIndex, 3>& face, const mesh::ScalarMesh& mesh,
                   const DiagonalUnits& units) {
    std::array<mesh::PointIndex, 3> p = face;
    double sign = -1.0;  // outward normals have the corners counter-clockwise
    auto ascend = [&](std::size_t i, std::size_t j) {
        if (p[i] < p[j]) return;
        std::swap(p[i], p[j]);
        sign = -sign;
    };
    ascend(0, 1);
    ascend(1, 2);
    ascend(0, 1);
    const glm::dvec3 a = units.place(mesh.positions[p[0]]), ab = units.step(mesh.positions[p[0]], mesh.positions[p[1]]),
                     ac = units.step(mesh.positions[p[0]], mesh.positions[p[2]]);
    const glm::dvec3 across = glm::cross(ab, ac);
    const double area = glm::length(across),
                 longest = std::max({glm::length(ab), glm::length(ac), glm::distance(ab, ac)});
    if (!(area > leastHeight * longest)) return glm::dvec4(0);
    const glm::dvec3 normal = across * (sign / area);
    return {normal, -glm::dot(normal, a)};
}

}  // namespace

RoundedPlanes::RoundedPlanes(const mesh::ScalarMesh& mesh) : units_(mesh.bounds) {
    const std::size_t faces = 4 * mesh.cells.size();
    for (auto* numbers : {&x_, &y_, &z_, &w_}) numbers->resize(faces);

    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, mesh.cells.size(), 4096), [&](const auto& range) {
        for (std::size_t i = range.begin(); i != range.end(); ++i)
            for (std::size_t k = 0; k < 4; ++k) {
                std::array<mesh::PointIndex, 3> face;
                for (std::size_t j = 0; j < 3; ++j)
                    face[j] = mesh.cells[i][static_cast<std::size_t>(mesh::faceVertices[k][j])];
                const glm::dvec4 plane = glm::round(planeOf(face, mesh, units_) * steps);
                x_[4 * i + k] = static_cast<std::int16_t>(plane.x);
                y_[4 * i + k] = static_cast<std::int16_t>(plane.y);
                z_[4 * i + k] = static_cast<std::int16_t>(plane.z);
                w_[4 * i + k] = static_cast<std::int16_t>(plane.w);
            }
    });
}

RoundedPlanes::Eye RoundedPlanes::eye(const CameraFrame& frame) const {
    const glm::dvec4 eye = units_.eye(frame);
    const glm::dvec4 size = glm::abs(eye);
    return {static_cast<float>(eye.x), static_cast<float>(eye.y), static_cast<float>(eye.z), static_cast<float>(eye.w),
            static_cast<float>(errorSteps * (size.x + size.y + size.z + size.w))};
}

void RoundedPlanes::sides(mesh::CellIndex first, std::size_t count, const Eye& eye, std::uint8_t* sides) const {
    constexpr std::size_t atOnce = 64;  // plain loops over arrays of fixed size: compilers make vectors of them
    std::array<std::uint8_t, 4 * atOnce> faces;
    for (std::size_t begin = 0; begin < count; begin += atOnce) {
        const std::size_t cells = std::min(atOnce, count - begin), face = 4 * (first + begin);
        const std::int16_t *x = x_.data() + face, *y = y_.data() + face, *z = z_.data() + face, *w = w_.data() + face;
        for (std::size_t i = 0; i < 4 * cells; ++i) {
            const float value = static_cast<float>(x[i]) * eye.x + static_cast<float>(y[i]) * eye.y +
                                static_cast<float>(z[i]) * eye.z + static_cast<float>(w[i]) * eye.w;
            faces[i] = static_cast<std::uint8_t>((value < -eye.error ? 1 : 0) | (value > eye.error ? 16 : 0));
        }
        for (std::size_t i = 0; i < cells; ++i) {
            unsigned cell = 0;
            for (unsigned k = 0; k < 4; ++k) cell |= static_cast<unsigned>(faces[4 * i + k]) << k;
            sides[begin + i] = static_cast<std::uint8_t>(cell);
        }
    }
}

}  // namespace tetralux::projection
