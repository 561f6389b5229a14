// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include <projection/core/pixel_maps.h>

namespace tetralux::projection {

/// A plane and the side of it that stays: that towards which `normal` points, as VTK's clipping planes have it.
struct HalfSpace {
    glm::dvec3 point;   ///< mesh units
    glm::dvec3 normal;  ///< any length > 0
};

/// The six half-spaces within low … high.
std::vector<HalfSpace> boxHalfSpaces(const glm::dvec3& low, const glm::dvec3& high);

/// The two half-spaces between parallel planes through `point`, `thickness` apart, `point` in the middle.
std::vector<HalfSpace> slabHalfSpaces(const glm::dvec3& point, const glm::dvec3& normal, double thickness);

/// Shows the volume only within all of its half-spaces: a convex region, of which a ray meets one interval. Slices
/// behind it among the scene's sources are clipped too, surfaces are not.
class ClipRegion final : public PixelMapSource {
public:
    /// \throws std::runtime_error for a normal without direction or numbers that are not finite.
    explicit ClipRegion(std::vector<HalfSpace> halfSpaces);

    void apply(const Camera& camera, PixelMaps& maps) const override;

private:
    std::vector<HalfSpace> halfSpaces_;  // unit normals
};

}  // namespace tetralux::projection
