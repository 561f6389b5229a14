// SPDX-License-Identifier: Apache-2.0
/// \file
/// Lights and materials as the fast engines read them: floats, lengths in scene units, directions along the world's
/// axes, places relative to a point of the view's axis near the mesh (so that float holds them wherever the mesh lies
/// and however far the eye is).
#pragma once

#include <array>
#include <memory>
#include <vector>

#include <glm/vec3.hpp>

#include <projection/cells/cell_setup.h>
#include <projection/core/camera.h>
#include <projection/core/scene.h>
#include <shading/vertex_light.h>

namespace tetralux::projection {

/// One light for one camera.
struct FrameLight {
    int kind = 0;        ///< 0 directional, 1 point, 2 at the eye
    glm::vec3 place{0};  ///< direction towards it, or place
    glm::vec3 color{1};
    glm::vec3 fade{1, 0, 0};  ///< attenuation: constant, per scene length, per scene length squared
};

/// LightModel of shading/light_model.glsl, in float.
struct LightModelFloats {
    int kind = 0, phase = 0;
    glm::vec3 frontSpecular, backSpecular;
    float frontExponent, backExponent;
    float diffuse, specular, diffuseThrough, specularThrough;
    float kappa, gamma, asymmetry;
    glm::vec3 ambient;
};

LightModelFloats lightModelFloats(const shading::ShadingSettings& settings);
/// Places are relative to the point on the view's axis at `depthReference` (scene lengths; depthReferenceOf).
std::vector<FrameLight> frameLights(const shading::ShadingSettings& settings, const SceneUnits& units,
                                    const CameraFrame& frame, double depthReference);

/// What vertices carry for the scene's light: what the scene brings along, or else computed now, with anisotropy that
/// was `kept`.
std::shared_ptr<const shading::VertexLight> vertexLightOf(const Scene& scene,
                                                          const std::vector<shading::Tensor>* kept = nullptr);

/// The scene with that computed, so that several engines need not.
Scene withVertexLight(Scene scene, const std::vector<shading::Tensor>* kept = nullptr);

}  // namespace tetralux::projection
