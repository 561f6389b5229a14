// SPDX-License-Identifier: Apache-2.0
/// \file
/// The yardstick: every pixel's ray cut by every cell that it meets, in double precision, straight from the definition
/// of the image. It shares no formula of projection or integration with the fast engines: no table, no projected
/// planes.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec4.hpp>

#include <preint/exact_integral.h>
#include <projection/core/camera.h>
#include <projection/core/pixel_maps.h>
#include <projection/core/scene.h>
#include <projection/image/image.h>

namespace tetralux::projection {

/// Where a ray runs through one cell: distances ≥ 0 along the ray (mesh units) and the scalars there.
struct RaySegment {
    double tIn, tOut;
    double scalarIn, scalarOut;
    mesh::CellIndex cell;
    bool inCutLayer = false;  ///< lit by the normal of a cut (PixelMaps::cutLayerEnd)
};

/// A share of the way from one scalar to another: from their difference, so that between equal numbers it is that
/// number and between others none beyond them.
inline double scalarBetween(double from, double to, double share) {
    return share < 1.0 ? std::clamp(from + share * (to - from), std::min(from, to), std::max(from, to)) : to;
}

struct RayCastCounts {
    std::uint64_t cellsDrawn = 0;  ///< cells that at least one ray meets
    std::uint64_t segments = 0;
    /// Segments that begin clearly before the previous one ended: cells that interpenetrate.
    std::uint64_t overlaps = 0;
};

class ReferenceRayCaster {
public:
    explicit ReferenceRayCaster(const Scene& scene);

    /// The whole image, within the limits of the view's pixel maps.
    Image render(const View& view, RayCastCounts& counts) const;

    /// Only the pixels named (y·width + x, ascending), written into `image`, which has the camera's size.
    void renderPixels(const View& view, const std::vector<std::uint32_t>& pixels, Image& image) const;

    /// The segments of the ray through pixel coordinates (x, y), whole at pixel centres, sorted by depth: for tests and
    /// inspection. O(cells).
    std::vector<RaySegment> segmentsAt(const Camera& camera, double x, double y) const;

private:
    struct Pass;
    /// What the pixel maps say of one pixel.
    struct PixelLimits {
        double nearest = 0.0, farthest = HUGE_VAL;
        double cutLayerEnd = 0.0;  ///< up to here light falls on `cutNormal`
        glm::dvec3 cutNormal{0};
        double extinctionScale = 1.0;
        DepthRange depths{0.0, 1.0};                       ///< of the camera, the same for all pixels
        std::span<const TranslucentFragment> translucent;  ///< of the pixel, by distance
        double pixelAtEye = 0.0, pixelPerDistance = 0.0;   ///< size of a pixel where a ray begins, and beyond
    };
    static PixelLimits limitsAt(const PixelMaps* maps, std::size_t pixel);
    glm::dvec4 colorOf(const Ray& ray, const PixelLimits& limits, std::vector<RaySegment>& segments) const;
    glm::dvec4 betweenTranslucent(const Ray& ray, const preint::ExactIntegral& exact, const PixelLimits& limits,
                                  const std::vector<RaySegment>& segments) const;
    glm::dvec4 composite(const Ray& ray, const preint::ExactIntegral& exact, const PixelLimits& limits,
                         std::vector<RaySegment>& segments) const;

    Scene scene_;  // with what its vertices carry for light
    preint::ExactIntegral exact_;
};

}  // namespace tetralux::projection
