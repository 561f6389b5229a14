// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include <glm/vec2.hpp>

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

/// The layer behind a cut where nothing is said: so much of the diagonal of the mesh's box.
inline constexpr double cutLayerShare = 1.0 / 200.0;

/// Shows the volume only within all of its half-spaces: a convex region, of which a ray meets one interval. Slices
/// behind it among the scene's sources are clipped too, surfaces are not. Light falls on what lies behind the plane
/// through which a ray comes in, no farther from it than `cutLayer`, by the plane's normal.
class ClipRegion final : public PixelMapSource {
public:
    /// `cutLayer`: mesh units along the planes' normals, from 0. \throws std::runtime_error for a normal without
    /// direction or numbers that are not finite.
    ClipRegion(std::vector<HalfSpace> halfSpaces, double cutLayer);

    void apply(const Camera& camera, PixelMaps& maps) const override;

    const std::vector<HalfSpace>& halfSpaces() const { return halfSpaces_; }

    /// Where along a ray the region begins and ends (mesh units; begin ≥ end: nowhere, begin may be less than 0).
    glm::dvec2 within(const Ray& ray) const;

private:
    std::vector<HalfSpace> halfSpaces_;  // unit normals
    double cutLayer_;
};

}  // namespace tetralux::projection
