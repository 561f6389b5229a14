// SPDX-License-Identifier: Apache-2.0
#include <projection/cpu/cpu_limits.h>

#include <glm/geometric.hpp>

#include <projection/cells/ray_inverse_depth.h>

namespace tetralux::projection {

TileLimits tileLimits(const PixelMaps& maps, const CameraFrame& camera, const TileFrame& frame,
                      const SceneUnits& units) {
    InverseDepthMaps rayInverseDepth = inverseDepthMaps(maps, camera, units, frame.depthReference);
    TileLimits limits{std::move(rayInverseDepth.nearest),
                      std::move(rayInverseDepth.farthest),
                      std::move(rayInverseDepth.cutLayerEnd),
                      maps.extinctionScale,
                      {}};
    limits.normal.reserve(maps.cutNormal.size());
    for (const glm::vec3& world : maps.cutNormal) {
        const glm::dvec3 normal(world);
        limits.normal.push_back({static_cast<float>(glm::dot(normal, camera.right)),
                                 static_cast<float>(-glm::dot(normal, camera.up)),
                                 static_cast<float>(glm::dot(normal, camera.forward))});
    }
    return limits;
}

}  // namespace tetralux::projection
