// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include <glm/vec3.hpp>

namespace tetralux::shading {

/// A light infinitely far away, of intensity 1, not attenuated.
struct DirectionalLight {
    glm::dvec3 towards{0, 0, 1};  ///< unit vector towards the light, world space
};

struct ShadingSettings {
    bool silhouette = false;               ///< Kraus 2005, Equations 15 and 17
    std::vector<DirectionalLight> lights;  ///< none: colours are emitted as they are
    double ambient = 0.1;                  ///< intensity of ambient light, used when there are lights
    double exponent = 32.0;                ///< of the specular lobes
    bool transmission = true;              ///< diffuse and specular light through the cell

    bool lit() const { return !lights.empty(); }
    bool needsGradient() const { return silhouette || lit(); }
};

}  // namespace tetralux::shading
