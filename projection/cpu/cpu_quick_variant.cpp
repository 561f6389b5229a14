// SPDX-License-Identifier: Apache-2.0
#include <projection/cpu/cpu_quick_variant.h>

#include <cmath>

#include <glm/geometric.hpp>

namespace tetralux::projection {

namespace {

/// Largest whole exponent that is taken by squaring: rounding stays below 1e-4.
constexpr double largestWholeExponent = 1024;

/// Whether ShadingVariant::LocalLights knows all that lights and material ask for.
bool localLightsSuffice(const shading::ShadingSettings& settings) {
    using shading::Reflectance;
    const shading::MaterialSide &front = settings.material.front, &back = settings.material.back;
    return (settings.reflectance == Reflectance::Phong || settings.reflectance == Reflectance::BlinnPhong) &&
           settings.normals == shading::Normals::Cell && !settings.needsShadows() &&
           !settings.material.phaseAsymmetry &&
           settings.material.specularByGradient == shading::GradientSpecular::Off && front.specular == back.specular &&
           front.exponent == back.exponent;
}

QuickLight quickLight(const FrameLight& light, const glm::vec3& specular, const TileFrame& frame) {
    QuickLight localLight;
    localLight.kind = light.kind;
    localLight.fades = light.kind != 0 && light.fade != glm::vec3(1, 0, 0);
    for (int c = 0; c < 3; ++c) {
        localLight.place[c] = glm::dot(light.place, frame.axes[static_cast<std::size_t>(c)]);
        localLight.color[c] = light.color[c];
        localLight.specular[c] = light.color[c] * specular[c];
        localLight.fade[c] = light.fade[c];
    }
    return localLight;
}

}  // namespace

bool silhouettesAtMost(const shading::ShadingSettings& settings) {
    return !settings.lit() && !settings.smoothSilhouettes() && settings.gradientOpacity == 0 &&
           !settings.approximateSilhouette && !settings.depthColor;
}

QuickVariant quickVariant(const shading::ShadingSettings& shading, const TileFrame& frame) {
    QuickVariant quick;
    const bool plain = shading.plain();
    if (shading.smoothSilhouettes() || shading.gradientOpacity > 0 || shading.approximateSilhouette ||
        shading.depthColor || frame.fullLights.size() > QuickVariant::mostLights ||
        (!plain && !localLightsSuffice(shading)))
        return quick;
    quick.variant = frame.fullLights.empty() ? ShadingVariant::Silhouettes
                    : plain                  ? ShadingVariant::Lit
                                             : ShadingVariant::LocalLights;
    quick.silhouettes = shading.silhouette;
    quick.transmission = shading.transmission;
    quick.orthographic = frame.orthographic;
    for (const FrameLight& light : frame.fullLights) {
        QuickLight& localLight = quick.localLights[quick.lights++];
        localLight = quickLight(light, frame.lightModel.frontSpecular, frame);
        quick.places = quick.places || localLight.kind == 1 || localLight.fades;
    }
    for (int c = 0; c < 3; ++c) quick.ambient[c] = frame.lightModel.ambient[c];
    quick.halfway = shading.reflectance == shading::Reflectance::BlinnPhong;
    quick.diffuse = frame.lightModel.diffuse;
    quick.specular = frame.lightModel.specular;
    quick.diffuseThrough = frame.lightModel.diffuseThrough;
    quick.specularThrough = frame.lightModel.specularThrough;
    const double exponent = shading.material.front.exponent.value_or(shading.exponent), whole = std::round(exponent);
    quick.exponent = static_cast<float>(exponent);
    if (whole == exponent && whole >= 1 && whole <= largestWholeExponent)
        quick.wholeExponent = static_cast<unsigned>(whole);
    if (exponent > 0) quick.leastCosine = static_cast<float>(std::pow(1e-8, 1 / exponent));
    return quick;
}

}  // namespace tetralux::projection
