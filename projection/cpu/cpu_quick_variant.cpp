// SPDX-License-Identifier: Apache-2.0
#include <projection/cpu/cpu_quick_look.h>

#include <cmath>

#include <glm/geometric.hpp>

namespace tetralux::projection {

namespace {

/// Largest whole exponent that is taken by squaring: rounding stays below 1e-4.
constexpr double largestWholeExponent = 1024;

/// Whether Look::Lamps knows all that lights and material ask for.
bool lampsSuffice(const shading::ShadingSettings& settings) {
    using shading::Reflectance;
    const shading::MaterialSide &front = settings.material.front, &back = settings.material.back;
    return (settings.reflectance == Reflectance::Phong || settings.reflectance == Reflectance::BlinnPhong) &&
           settings.normals == shading::Normals::Cell && !settings.needsShadows() &&
           !settings.material.phaseAsymmetry &&
           settings.material.specularByGradient == shading::GradientSpecular::Off && front.specular == back.specular &&
           front.exponent == back.exponent;
}

QuickLamp quickLamp(const FrameLight& light, const glm::vec3& specular, const TileFrame& frame) {
    QuickLamp lamp;
    lamp.kind = light.kind;
    lamp.fades = light.kind != 0 && light.fade != glm::vec3(1, 0, 0);
    for (int c = 0; c < 3; ++c) {
        lamp.place[c] = glm::dot(light.place, frame.axes[static_cast<std::size_t>(c)]);
        lamp.color[c] = light.color[c];
        lamp.specular[c] = light.color[c] * specular[c];
        lamp.fade[c] = light.fade[c];
    }
    return lamp;
}

}  // namespace

bool silhouettesAtMost(const shading::ShadingSettings& settings) {
    return !settings.lit() && !settings.smoothSilhouettes() && settings.gradientOpacity == 0 &&
           !settings.approximateSilhouette && !settings.depthColor;
}

QuickLook quickLook(const shading::ShadingSettings& shading, const TileFrame& frame) {
    QuickLook quick;
    const bool plain = shading.plain();
    if (shading.smoothSilhouettes() || shading.gradientOpacity > 0 || shading.approximateSilhouette ||
        shading.depthColor || frame.fullLights.size() > QuickLook::mostLights || (!plain && !lampsSuffice(shading)))
        return quick;
    quick.look = frame.fullLights.empty() ? Look::Silhouettes : plain ? Look::Lit : Look::Lamps;
    quick.silhouettes = shading.silhouette;
    quick.transmission = shading.transmission;
    quick.orthographic = frame.orthographic;
    for (const FrameLight& light : frame.fullLights) {
        QuickLamp& lamp = quick.lamps[quick.lights++];
        lamp = quickLamp(light, frame.lightModel.frontSpecular, frame);
        quick.places = quick.places || lamp.kind == 1 || lamp.fades;
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
