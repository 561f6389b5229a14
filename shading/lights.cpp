// SPDX-License-Identifier: Apache-2.0
#include <shading/lights.h>

#include <algorithm>

namespace tetralux::shading {

namespace {

bool isPlain(const Light& light) {
    return light.kind == Light::Kind::Directional && light.color == glm::dvec3(1);
}

bool isPlain(const MaterialSide& side) {
    return side.specular == glm::dvec3(1) && !side.exponent;
}

bool isPlain(const Material& material) {
    return material.diffuse == 1 && material.specular == 1 && material.diffuseTransmission == 1 &&
           material.specularTransmission == 1 && !material.phaseAsymmetry &&
           material.specularByGradient == GradientSpecular::Off && isPlain(material.front) && isPlain(material.back);
}

}  // namespace

bool ShadingSettings::needsShadows() const {
    return shadows.on && std::any_of(lights.begin(), lights.end(),
                                     [](const Light& light) { return light.kind != Light::Kind::Head; });
}

bool ShadingSettings::plain() const {
    return std::all_of(lights.begin(), lights.end(), [](const Light& light) { return isPlain(light); }) &&
           isPlain(material) && ambientColor == glm::dvec3(1) && reflectance == Reflectance::Phong &&
           normals == Normals::Cell && !needsShadows();
}

}  // namespace tetralux::shading
