// SPDX-License-Identifier: Apache-2.0
/// \file
/// Internal: where a mesh ends near a point, as seen from there along a level set.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include <glm/vec3.hpp>

#include <mesh/tet/tet_mesh.h>
#include <shading/ball_cubes.h>
#include <shading/cut_disc.h>

namespace tetralux::shading {

/// The level sets about a point: z = ½(xx·x² + 2·xy·xy + yy·y²) + h, |h| ≤ thickness; lengths in radii. `x`, `y`, `z`
/// are orthonormal and right-handed.
struct BentDisc {
    glm::dvec3 x, y, z;
    double xx = 0, yy = 0, xy = 0;
    double thickness = 0;
};

/// The faces that only one cell has.
class MeshBorder {
public:
    /// `radius` in mesh units, > 0; at least one cell.
    MeshBorder(const mesh::ScalarMesh& mesh, double radius);

    /// Whether a part of the border may be within the radius of a place.
    bool isNear(const glm::dvec3& place) const;

    /// How much of the disc about a point of the mesh lies in the mesh; nothing where the border does not cut it.
    std::optional<SeenDisc> cut(const glm::dvec3& place, mesh::PointIndex point, const BentDisc& disc) const;

private:
    using Corners = std::array<glm::vec3, 3>;
    struct Cut;

    void cutByFaces(std::size_t first, std::size_t last, Cut& cut) const;
    void cutByFacesWide(std::size_t first, std::size_t last, Cut& cut) const;

    void addFace(const Corners& corners, std::vector<Corners>& faces) const;
    double largestFace() const { return 0.6 * cubes_.side(); }

    const BallCubes cubes_;
    std::vector<std::size_t> starts_;      ///< per cube its first face, and the end; large faces are several
    std::vector<Corners> corners_;         ///< in radii; counter-clockwise from outside
    std::vector<float> x_, y_, z_, size_;  ///< of faces: middle, largest distance of a corner from it
    std::vector<glm::vec3> inwards_;       ///< per point of the border a direction into the mesh; else 0
};

}  // namespace tetralux::shading
