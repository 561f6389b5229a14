// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include <glm/vec3.hpp>

#include <mesh/tet/tet_mesh.h>

namespace tetralux::shading {

/// Cubes over a mesh's bounding box, for what lies within a radius of a place. Lengths in radii, from `origin()`.
class BallCubes {
public:
    using Place = std::array<std::size_t, 3>;

    /// Of half a radius, so that the cubes about a ball are not much more than the ball; larger where that would be
    /// more cubes than cells (a mesh with a few fine parts). `radius` in mesh units, > 0.
    BallCubes(const mesh::ScalarMesh& mesh, double radius) : perRadius_(1 / radius), origin_(mesh.bounds.low) {
        const glm::dvec3 size = (mesh.bounds.high - mesh.bounds.low) * perRadius_;
        const double most = std::max<double>(64.0, static_cast<double>(mesh.cells.size()));
        const auto along = [&](int axis) { return std::floor(size[axis] / side_) + 1; };
        while (along(0) * along(1) * along(2) > most) side_ *= 1.25;
        for (int axis = 0; axis < 3; ++axis)
            counts_[static_cast<std::size_t>(axis)] = static_cast<std::size_t>(along(axis));
    }

    double side() const { return side_; }
    std::size_t count() const { return counts_[0] * counts_[1] * counts_[2]; }
    glm::dvec3 fromOrigin(const glm::dvec3& position) const { return (position - origin_) * perRadius_; }
    glm::dvec3 corner(const Place& place) const { return side_ * glm::dvec3(place[0], place[1], place[2]); }
    std::size_t cubeOf(const Place& place) const { return (place[2] * counts_[1] + place[1]) * counts_[0] + place[0]; }

    /// What lies outside belongs to the cube nearest to it.
    Place placeOf(const glm::dvec3& fromOrigin) const {
        Place place;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const double at = std::floor(fromOrigin[static_cast<int>(axis)] / side_);
            place[axis] = static_cast<std::size_t>(std::clamp(at, 0.0, static_cast<double>(counts_[axis] - 1)));
        }
        return place;
    }

    /// Calls `use(first, last)` for every row of cubes from the one of `low` to that of `high`.
    template <class Use>
    void forRows(const glm::dvec3& low, const glm::dvec3& high, const Use& use) const {
        const Place first = placeOf(low), last = placeOf(high);
        for (std::size_t k = first[2]; k <= last[2]; ++k)
            for (std::size_t j = first[1]; j <= last[1]; ++j) use(Place{first[0], j, k}, Place{last[0], j, k});
    }

private:
    double perRadius_;
    glm::dvec3 origin_;
    double side_ = 0.5;
    Place counts_{1, 1, 1};
};

}  // namespace tetralux::shading
