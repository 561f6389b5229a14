// SPDX-License-Identifier: Apache-2.0
/// \file
/// The yardstick: every pixel's ray cut by every cell that it meets, in double precision, straight from the definition
/// of the image. It shares no formula of projection or integration with the fast engines: no table, no projected
/// planes.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/vec4.hpp>

#include <preint/exact_integral.h>
#include <projection/camera.h>
#include <projection/image.h>
#include <projection/scene.h>

namespace tetralux::projection {

/// Where a ray runs through one cell: distances ≥ 0 along the ray (mesh units) and the scalars there.
struct RaySegment {
    double tIn, tOut;
    double scalarIn, scalarOut;
    mesh::CellIndex cell;
};

struct RayCastCounts {
    std::uint64_t cellsDrawn = 0;  ///< cells that at least one ray meets
    std::uint64_t segments = 0;
    std::uint64_t overlaps =
        0;  ///< segments that begin clearly before the previous one ended: cells that interpenetrate
};

class ReferenceRayCaster {
public:
    explicit ReferenceRayCaster(const Scene& scene);

    /// The whole image.
    Image render(const Camera& camera, RayCastCounts& counts) const;

    /// Only the pixels named (y·width + x, ascending), written into `image`, which has the camera's size.
    void renderPixels(const Camera& camera, const std::vector<std::uint32_t>& pixels, Image& image) const;

    /// The segments of the ray through pixel coordinates (x, y), whole at pixel centres, sorted by depth: for tests and
    /// inspection. O(cells).
    std::vector<RaySegment> segmentsAt(const Camera& camera, double x, double y) const;

private:
    struct Pass;
    glm::dvec4 composite(const Ray& ray, std::vector<RaySegment>& segments) const;

    Scene scene_;
    preint::ExactIntegral exact_;
};

}  // namespace tetralux::projection
