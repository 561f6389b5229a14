// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <projection/cells/cell_shading.h>
#include <shading/lights.h>

namespace tetralux::projection {

/// Unit direction to a light and what of it arrives, shadows apart.
struct ArrivingLight {
    glm::dvec3 towards, color;
};

/// At `point`, which stands at the distance `fromEye` along a ray of unit direction `direction` (mesh units).
inline ArrivingLight arrivingLight(const shading::Light& light, const glm::dvec3& point, const glm::dvec3& direction,
                                   double fromEye) {
    switch (light.kind) {
        case shading::Light::Kind::Directional:
            return {glm::normalize(light.towards), light.color};
        case shading::Light::Kind::Point: {
            const glm::dvec3 way = light.position - point;
            const double distance = glm::length(way);
            if (!(distance > 0)) return {-direction, light.color * glsl::attenuation(light.attenuation, 0.0)};
            return {way / distance, light.color * glsl::attenuation(light.attenuation, distance)};
        }
        case shading::Light::Kind::Head:
            break;
    }
    return {-direction, light.color * glsl::attenuation(light.attenuation, fromEye)};
}

}  // namespace tetralux::projection
