// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <mesh/tet/tet_mesh.h>
#include <projection/core/camera.h>
#include <projection/core/scene.h>

namespace tetralux::projection {

/// Faces that are seen edge-on, or nearly so. The length of a ray in a cell changes from one side of such a face to the
/// other within a small part of a pixel: floats, and samples beside the centres, stand elsewhere within it than the
/// reference's rays, or on the other side.
class EdgeOnFaces {
public:
    explicit EdgeOnFaces(const Scene& scene);

    /// Pixels (y·width + x, in no order, some twice) in which that may show: the ray through the centre runs through,
    /// or within float's rounding beside, such a face of one of `cells`, steep enough that where it stands there makes
    /// opacity err by more than `largestError`. `frame.sampleShift`: where the engine's samples stand.
    std::vector<std::uint32_t> pixels(const CameraFrame& frame, std::span<const mesh::CellIndex> cells) const;

    /// The cells of the mesh that may have such a face, and a few more: for engines that do not find them by
    /// themselves.
    std::vector<mesh::CellIndex> candidates(const CameraFrame& frame) const;

private:
    double visiblePerLength(mesh::CellIndex cell) const;

    Scene scene_;
    bool anythingShows_;  ///< however little of it a ray meets
};

}  // namespace tetralux::projection
