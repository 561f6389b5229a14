// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

#include <mesh/tet/tet_mesh.h>
#include <projection/core/camera.h>

namespace tetralux::projection {

/// The planes that many faces of a mesh share, as those of grids do, and where samples stand so that no ray runs within
/// one. Float planes of two cells could not agree on such a ray: both would claim it, or neither. Where a view meets
/// such a plane edge-on and the plane passes through pixel centres, samples stand as far beside the centres as floats
/// need to tell for cells of the mesh's size; in all other views practically at them, because every 1e-5 pixel beside
/// the centre is one picture in a thousand in which the outline of an isosurface falls into another pixel.
class EdgeOnPlanes {
public:
    static constexpr glm::dvec2 barely{0x1p-32, 0x1p-33}, widest{0x1p-14, 0x1p-15};  ///< pixels

    /// Looks at no more than some 5e4 faces: a plane that is worth a shift holds many.
    explicit EdgeOnPlanes(const mesh::ScalarMesh& mesh);

    /// For CameraFrame::sampleShift.
    glm::dvec2 sampleShift(const CameraFrame& frame) const;

    std::size_t count() const { return planes_.size(); }

private:
    /// Unit normal, offset: positions in mesh diagonals from the centre of the bounds.
    std::vector<glm::dvec4> planes_;
    glm::dvec3 centre_;
    double perLength_;
    double longestEdge_ = 0;  ///< of the faces looked at, diagonals
};

/// The frame of a camera with its samples where they belong.
CameraFrame sampledFrame(const Camera& camera, const EdgeOnPlanes& planes);

}  // namespace tetralux::projection
