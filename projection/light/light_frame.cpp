// SPDX-License-Identifier: Apache-2.0
#include <projection/light/light_frame.h>

#include <utility>

#include <glm/geometric.hpp>

#include <projection/light/light_shadows.h>
#include <projection/light/vertex_samples.h>

namespace tetralux::projection {

LightModelFloats lightModelFloats(const shading::ShadingSettings& settings) {
    const shading::Material& material = settings.material;
    const float through = settings.transmission ? 1.0f : 0.0f;
    LightModelFloats model;
    model.kind = static_cast<int>(settings.reflectance);
    model.phase = material.phaseAsymmetry ? 1 : 0;
    model.frontSpecular = glm::vec3(material.front.specular);
    model.backSpecular = glm::vec3(material.back.specular);
    model.frontExponent = static_cast<float>(settings.exponentOf(material.front));
    model.backExponent = static_cast<float>(settings.exponentOf(material.back));
    model.diffuse = static_cast<float>(material.diffuse);
    model.specular = static_cast<float>(material.specular);
    model.diffuseThrough = through * static_cast<float>(material.diffuseTransmission);
    model.specularThrough = through * static_cast<float>(material.specularTransmission);
    model.kappa = static_cast<float>(settings.wardRoughness());
    model.gamma = static_cast<float>(settings.anisotropy.gamma);
    model.asymmetry = static_cast<float>(material.phaseAsymmetry.value_or(0.0));
    model.ambient = glm::vec3(settings.ambient * settings.ambientColor);
    return model;
}

std::vector<FrameLight> frameLights(const shading::ShadingSettings& settings, const SceneUnits& units,
                                    const CameraFrame& frame, double depthReference) {
    const glm::dvec3 origin = frame.eye + depthReference * units.length * frame.forward;
    std::vector<FrameLight> lights;
    for (const shading::Light& light : settings.lights) {
        FrameLight one;
        one.kind = static_cast<int>(light.kind);
        one.color = glm::vec3(light.color);
        if (light.kind == shading::Light::Kind::Directional) {
            one.place = glm::vec3(glm::normalize(light.towards));
        } else {
            const bool atEye = light.kind != shading::Light::Kind::Point;
            one.place = glm::vec3(((atEye ? frame.eye : light.position) - origin) / units.length);
            one.fade = glm::vec3(light.attenuation * glm::dvec3(1, units.length, units.length * units.length));
        }
        lights.push_back(one);
    }
    return lights;
}

std::shared_ptr<const shading::VertexLight> vertexLightOf(const Scene& scene,
                                                          const std::vector<shading::Tensor>* kept) {
    if (scene.vertexLight) return scene.vertexLight;
    shading::VertexLight light =
        shading::vertexLight(*scene.mesh, scene.settings.shading, samplesVertices(scene), kept);
    if (light.shadowAt >= 0) addShadows(scene, light);
    if (light.specularAt >= 0) addSpecularFactors(scene, light);
    if (light.sampleAt >= 0) addSamples(scene, light);
    if (light.shadowAt >= 0) addSurfaceShadows(scene, light);
    return std::make_shared<const shading::VertexLight>(std::move(light));
}

Scene withVertexLight(Scene scene, const std::vector<shading::Tensor>* kept) {
    scene.vertexLight = vertexLightOf(scene, kept);
    return scene;
}

}  // namespace tetralux::projection
