// SPDX-License-Identifier: Apache-2.0
#include <apps/light_options.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <stdexcept>
#include <vector>

#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <glm/geometric.hpp>

#include <apps/add_option.h>
#include <apps/option_values.h>
#include <projection/light/lighting_file.h>

namespace tetralux::apps {

namespace {

using shading::Light;

Light directionalLight(const std::string& text) {
    const glm::dvec3 direction = parseVector("--light", text);
    const double largest = std::max({std::abs(direction.x), std::abs(direction.y), std::abs(direction.z)});
    if (largest == 0.0)
        throw std::runtime_error("--light: 0,0,0 has no direction; give the direction towards the light");
    return {glm::normalize(direction / largest)};
}

/// x,y,z, or with intensity, or with intensity and colour.
Light pointLight(const std::string& text) {
    const auto count = static_cast<std::size_t>(std::count(text.begin(), text.end(), ',')) + 1;
    if (count != 3 && count != 4 && count != 7)
        throw std::runtime_error(
            fmt::format("--point-light: '{}' has {} numbers; give x,y,z[,intensity[,r,g,b]]", text, count));
    const std::vector<double> numbers = parseNumbers("--point-light", text, count, "x,y,z[,intensity[,r,g,b]]");
    if (std::any_of(numbers.begin() + 3, numbers.end(), [](double number) { return number < 0; }))
        throw std::runtime_error(
            fmt::format("--point-light: {} is darker than black; give intensity and colour from 0", text));
    Light light;
    light.kind = Light::Kind::Point;
    light.position = {numbers[0], numbers[1], numbers[2]};
    if (numbers.size() > 4) light.color = {numbers[4], numbers[5], numbers[6]};
    if (numbers.size() > 3) light.color *= numbers[3];
    return light;
}

/// "radius=4,gamma=60".
void setAnisotropy(const std::string& text, shading::AnisotropySettings& settings) {
    for (std::size_t begin = 0; begin <= text.size();) {
        const std::size_t end = std::min(text.find(',', begin), text.size());
        const std::string pair = text.substr(begin, end - begin);
        const std::size_t equals = std::min(pair.find('='), pair.size());
        if (equals == pair.size())
            throw std::runtime_error(
                fmt::format("--anisotropy: '{}' has no value; write as in radius=4,gamma=60", pair));
        const std::vector<double> value =
            parseNumbers("--anisotropy", pair.substr(equals + 1), 1, "numbers as in radius=4,gamma=60");
        projection::setAnisotropyParameter("--anisotropy", pair.substr(0, equals), value.front(), settings);
        begin = end + 1;
    }
}

void addSpecularByGradient(CLI::App& command, shading::Material& material) {
    using shading::GradientSpecular;
    const auto how = std::make_shared<std::string>();
    command
        .add_flag("--specular-by-gradient{relative}", *how,
                  "highlights as strong as the gradient of extinction over its largest (relative, if nothing is said), "
                  "or as it is (absolute): only where it rises do things shine")
        ->type_name("[relative|absolute]")
        ->each([how, &material](const std::string& text) {
            if (text != "relative" && text != "absolute")
                throw std::runtime_error(
                    fmt::format("--specular-by-gradient: '{}' will not do; give relative or absolute", text));
            material.specularByGradient = text == "relative" ? GradientSpecular::Relative : GradientSpecular::Absolute;
        });
}

}  // namespace

void addLightOptions(CLI::App& command, shading::ShadingSettings& settings) {
    // first, so that the other options have the last word
    command
        .add_option_function<std::string>(
            "--lighting", [&settings](const std::string& path) { projection::readLighting(path, settings); },
            "JSON file with lights and materials; the other options have the last word")
        ->type_name("FILE.json");
    addRepeated(command, "--light", "dx,dy,dz", "direction towards a light; may be given several times",
                [&settings](const std::string& text) { settings.lights.push_back(directionalLight(text)); });
    addRepeated(command, "--point-light", "x,y,z[,I[,r,g,b]]",
                "light at a point (mesh units), its intensity and colour; may be given several times",
                [&settings](const std::string& text) { settings.lights.push_back(pointLight(text)); });
    command.add_flag_callback(
        "--headlight",
        [&settings] {
            Light light;
            light.kind = Light::Kind::Head;
            settings.lights.push_back(light);
        },
        "a light at the eye");
    addNumber<double>(command, "--ambient", settings.ambient, notNegative, "a number from 0",
                      "ambient light, 0.1 (Kraus 2005, Equation 19)");
    addNumber<double>(command, "--exponent", settings.exponent, notNegative, "a number from 0",
                      "specular exponent, 32");
    command.add_flag_callback(
        "--no-transmission", [&settings] { settings.transmission = false; }, "no light through the layers");
    command
        .add_option_function<std::string>(
            "--reflectance",
            [&settings](const std::string& name) { projection::setReflectance("--reflectance", name, settings); },
            "how highlights are formed: phong, blinn-phong, ward and lafortune (stretched along the field's fibres), "
            "none; "
            "henyey-greenstein: none, and a phase function")
        ->type_name("NAME");
    command
        .add_option_function<double>(
            "--phase-asymmetry",
            [&settings](double asymmetry) {
                projection::setPhaseAsymmetry("--phase-asymmetry", asymmetry, settings.material);
            },
            "diffuse light by Henyey and Greenstein's phase function with this g, from -1 (back) to 1 (onward)")
        ->type_name("G");
    addParsed(command, "--normals", settings.normals, projection::normalsOf,
              "cell: each cell's own; smooth: from gradients at the vertices, for light and silhouettes: where the "
              "field is rough "
              "or noisy and single cells show",
              "NAME");
    command
        .add_option_function<std::string>(
            "--anisotropy", [&settings](const std::string& text) { setAnisotropy(text, settings.anisotropy); },
            "for ward and lafortune: radius=4 (edge lengths), interval=0.05 (of the range), samples=4 (per cell), "
            "smoothing=0, kappa (ward: roughness, 0.2; lafortune: the exponent), gamma=10")
        ->type_name("KEY=VALUE,...");
    addSpecularByGradient(command, settings.material);
    command.add_flag("--shadows", settings.shadows.on, "volume and surfaces cast shadows");
    command.add_option_function<double>(
        "--soft-shadows",
        [&settings](double radius) {
            if (!std::isfinite(radius) || radius < 0)
                throw std::runtime_error(fmt::format("--soft-shadows: {} will not do; give a radius from 0", radius));
            settings.shadows.on = true;
            settings.shadows.softness = radius;
        },
        "shadows of lights of this radius: mesh units for point lights, tangent of the angle for directions");
}

}  // namespace tetralux::apps
