// SPDX-License-Identifier: Apache-2.0
#include <projection/light/lighting_file.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string_view>
#include <type_traits>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

#include <preint/json_reading.h>

namespace tetralux::projection {

namespace {

using preint::JsonPlace;
using shading::Light;

constexpr std::array reflectanceNames{"phong", "blinn-phong", "ward", "lafortune", "none", "henyey-greenstein"};
constexpr std::string_view phaseAlone = "henyey-greenstein";
constexpr double usualAsymmetry = 0.3;
constexpr std::array normalsNames{"cell", "smooth"};

/// Place of `name` among `names`.
template <std::size_t n>
int placeOf(const std::array<const char*, n>& names, const std::string& what, const std::string& name) {
    for (std::size_t i = 0; i < n; ++i)
        if (name == names[i]) return static_cast<int>(i);
    throw std::runtime_error(fmt::format("{}: there is no '{}'; take one of {}", what, name, fmt::join(names, ", ")));
}

/// Calls `use(member)` if the object has that key.
template <class Use>
void ifThere(const JsonPlace& object, const char* key, const Use& use) {
    if (object.value().contains(key)) use(object.member(key));
}

void requireObject(const JsonPlace& place, const std::vector<std::string>& keys) {
    if (!place.value().is_object()) place.fail("must be an object: {…}");
    preint::requireKnownKeys(place, keys);
}

double notNegative(const JsonPlace& place) {
    const double value = place.number();
    if (value < 0) place.fail(fmt::format("is {}, must not be negative", value));
    return value;
}

void setFactor(const JsonPlace& object, const char* key, double& target) {
    ifThere(object, key, [&](const JsonPlace& place) { target = notNegative(place); });
}

glm::dvec3 vectorOf(const JsonPlace& place) {
    place.array("[x, y, z]");
    if (place.size() != 3) place.fail(fmt::format("has {} numbers, must have three", place.size()));
    return {place.element(0).number(), place.element(1).number(), place.element(2).number()};
}

/// Three numbers ≥ 0; colours of lights may be more than 1.
glm::dvec3 notNegativeVector(const JsonPlace& place) {
    vectorOf(place);
    return {notNegative(place.element(0)), notNegative(place.element(1)), notNegative(place.element(2))};
}

Light lightOf(const JsonPlace& place) {
    requireObject(place, {"type", "towards", "position", "color", "intensity", "attenuation"});
    if (!place.value().contains("type")) place.fail("has no type; give \"directional\", \"point\" or \"head\"");
    const std::string type = place.member("type").text();
    Light light;
    if (type == "directional") {
        if (!place.value().contains("towards")) place.fail("has no \"towards\"; give the direction towards the light");
        const glm::dvec3 towards = vectorOf(place.member("towards"));
        const double largest = std::max({std::abs(towards.x), std::abs(towards.y), std::abs(towards.z)});
        if (largest == 0) place.member("towards").fail("has no direction; give the direction towards the light");
        light.towards = glm::normalize(towards / largest);
    } else if (type == "point") {
        light.kind = Light::Kind::Point;
        if (!place.value().contains("position")) place.fail("has no \"position\"; give [x, y, z] in mesh units");
        light.position = vectorOf(place.member("position"));
    } else if (type == "head") {
        light.kind = Light::Kind::Head;
    } else {
        place.member("type").fail("must be \"directional\", \"point\" or \"head\"");
    }
    ifThere(place, "color", [&](const JsonPlace& color) { light.color = notNegativeVector(color); });
    ifThere(place, "intensity", [&](const JsonPlace& intensity) { light.color *= notNegative(intensity); });
    ifThere(place, "attenuation", [&](const JsonPlace& attenuation) {
        light.attenuation = notNegativeVector(attenuation);
        if (light.attenuation == glm::dvec3(0)) attenuation.fail("is all 0; one of its numbers must be positive");
    });
    return light;
}

void readSide(const JsonPlace& place, shading::MaterialSide& side) {
    requireObject(place, {"specular", "exponent"});
    ifThere(place, "specular", [&](const JsonPlace& specular) { side.specular = notNegativeVector(specular); });
    ifThere(place, "exponent", [&](const JsonPlace& exponent) { side.exponent = notNegative(exponent); });
}

void readSpecularByGradient(const JsonPlace& place, shading::Material& material) {
    using shading::GradientSpecular;
    if (place.value().is_string()) {
        if (place.text() != "absolute") place.fail("must be true, false or \"absolute\"");
        material.specularByGradient = GradientSpecular::Absolute;
    } else {
        material.specularByGradient = place.boolean() ? GradientSpecular::Relative : GradientSpecular::Off;
    }
}

void readMaterial(const JsonPlace& place, shading::Material& material) {
    requireObject(place, {"diffuse", "specular", "diffuse_transmission", "specular_transmission", "front", "back",
                          "phase_asymmetry", "specular_by_gradient"});
    setFactor(place, "diffuse", material.diffuse);
    setFactor(place, "specular", material.specular);
    setFactor(place, "diffuse_transmission", material.diffuseTransmission);
    setFactor(place, "specular_transmission", material.specularTransmission);
    ifThere(place, "specular_by_gradient", [&](const JsonPlace& on) { readSpecularByGradient(on, material); });
    ifThere(place, "front", [&](const JsonPlace& side) { readSide(side, material.front); });
    ifThere(place, "back", [&](const JsonPlace& side) { readSide(side, material.back); });
    ifThere(place, "phase_asymmetry", [&](const JsonPlace& asymmetry) {
        if (!(std::abs(asymmetry.number()) < 1)) asymmetry.fail("must lie between -1 and 1");
        material.phaseAsymmetry = asymmetry.number();
    });
}

void readShadows(const JsonPlace& place, shading::ShadowSettings& shadows) {
    if (place.value().is_boolean()) {
        shadows.on = place.boolean();
        return;
    }
    requireObject(place, {"softness"});
    shadows.on = true;
    setFactor(place, "softness", shadows.softness);
}

void readDocument(const JsonPlace& document, const std::string& origin, shading::ShadingSettings& settings) {
    requireObject(document, {"ambient", "exponent", "transmission", "lights", "material", "reflectance", "normals",
                             "anisotropy", "shadows"});
    ifThere(document, "ambient", [&](const JsonPlace& ambient) {
        if (ambient.value().is_array()) {
            settings.ambientColor = notNegativeVector(ambient);
            settings.ambient = 1;
        } else {
            settings.ambient = notNegative(ambient);
        }
    });
    setFactor(document, "exponent", settings.exponent);
    ifThere(document, "transmission", [&](const JsonPlace& on) { settings.transmission = on.boolean(); });
    ifThere(document, "lights", [&](const JsonPlace& lights) {
        lights.array("[{\"type\": …}, …]");
        for (std::size_t i = 0; i < lights.size(); ++i) settings.lights.push_back(lightOf(lights.element(i)));
    });
    ifThere(document, "material", [&](const JsonPlace& material) { readMaterial(material, settings.material); });
    ifThere(document, "reflectance",
            [&](const JsonPlace& name) { setReflectance(origin + ": reflectance", name.text(), settings); });
    ifThere(document, "normals",
            [&](const JsonPlace& name) { settings.normals = normalsOf(origin + ": normals", name.text()); });
    ifThere(document, "anisotropy", [&](const JsonPlace& anisotropy) {
        if (!anisotropy.value().is_object()) anisotropy.fail("must be an object: {…}");
        for (const auto& [key, value] : anisotropy.value().items())
            setAnisotropyParameter(origin + ": anisotropy", key, anisotropy.member(key).number(), settings.anisotropy);
    });
    ifThere(document, "shadows", [&](const JsonPlace& shadows) { readShadows(shadows, settings.shadows); });
}

}  // namespace

void setReflectance(const std::string& what, const std::string& name, shading::ShadingSettings& settings) {
    const int place = placeOf(reflectanceNames, what, name);
    if (name == phaseAlone) {
        settings.reflectance = shading::Reflectance::None;
        if (!settings.material.phaseAsymmetry) settings.material.phaseAsymmetry = usualAsymmetry;
    } else {
        settings.reflectance = static_cast<shading::Reflectance>(place);
    }
}

void setPhaseAsymmetry(const std::string& what, double asymmetry, shading::Material& material) {
    if (!(std::abs(asymmetry) < 1))
        throw std::runtime_error(fmt::format("{}: {} will not do; give a number between -1 and 1", what, asymmetry));
    material.phaseAsymmetry = asymmetry;
}

shading::Normals normalsOf(const std::string& what, const std::string& name) {
    return static_cast<shading::Normals>(placeOf(normalsNames, what, name));
}

void setAnisotropyParameter(const std::string& what, const std::string& key, double value,
                            shading::AnisotropySettings& settings) {
    const auto set = [&](auto& target, double least, double most) {
        if (!(value >= least && value <= most))
            throw std::runtime_error(
                fmt::format("{}: {} is {}; give a number from {} to {}", what, key, value, least, most));
        if constexpr (std::is_same_v<decltype(target), int&>)
            target = static_cast<int>(value);
        else
            target = value;
    };
    if (key == "radius") return set(settings.radius, 0.5, 50);
    if (key == "interval") return set(settings.interval, 1e-6, 1);
    if (key == "samples") return set(settings.samples, 1, 1000);
    if (key == "smoothing") return set(settings.smoothing, 0, 100);
    if (key == "kappa") return set(settings.kappa, 1e-6, 1e4);
    if (key == "gamma") return set(settings.gamma, 0, 1e3);
    throw std::runtime_error(
        fmt::format("{}: there is no '{}'; take radius, interval, samples, smoothing, kappa or gamma", what, key));
}

void parseLighting(const std::string& text, const std::string& origin, shading::ShadingSettings& settings) {
    nlohmann::json document;
    try {
        document = nlohmann::json::parse(text);
    } catch (const nlohmann::json::parse_error& error) {
        throw std::runtime_error(fmt::format("{}: is not JSON (at byte {}); correct it there", origin, error.byte));
    }
    readDocument(JsonPlace(document, origin), origin, settings);
}

void readLighting(const std::string& path, shading::ShadingSettings& settings) {
    std::ifstream file(path, std::ios::binary);
    if (!file) throw std::runtime_error(fmt::format("{}: cannot be opened; check the path and its permissions", path));
    const std::string text{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
    if (file.bad() || text.empty())
        throw std::runtime_error(fmt::format("{}: is empty or cannot be read; give JSON with lights", path));
    parseLighting(text, path, settings);
}

}  // namespace tetralux::projection
