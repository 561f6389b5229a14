// SPDX-License-Identifier: Apache-2.0
#include <stdexcept>

#include <gtest/gtest.h>

#include <projection/light/lighting_file.h>

namespace tetralux::projection {
namespace {

TEST(LightingFile, SetsWhatItNames) {
    shading::ShadingSettings settings;
    settings.lights.resize(1);
    parseLighting(R"({"ambient": [0.1, 0.2, 0.3], "exponent": 8, "transmission": false,
        "lights": [{"type": "directional", "towards": [0, 0, 2], "intensity": 0.5},
                   {"type": "point", "position": [1, 2, 3], "attenuation": [0, 1, 2], "color": [2, 1, 0]}, {"type": "head"}],
        "material": {"diffuse": 0.5, "back": {"specular": [0, 0, 1], "exponent": 4}},
        "reflectance": "ward", "normals": "smooth", "anisotropy": {"gamma": 60}, "shadows": {"softness": 0.2}})",
                  "test", settings);
    ASSERT_EQ(settings.lights.size(), 4u);
    EXPECT_EQ(settings.lights[1].towards, glm::dvec3(0, 0, 1));
    EXPECT_EQ(settings.lights[1].color, glm::dvec3(0.5));
    EXPECT_EQ(settings.lights[2].kind, shading::Light::Kind::Point);
    EXPECT_EQ(settings.lights[2].position, glm::dvec3(1, 2, 3));
    EXPECT_EQ(settings.lights[2].attenuation, glm::dvec3(0, 1, 2));
    EXPECT_EQ(settings.lights[3].kind, shading::Light::Kind::Head);
    EXPECT_EQ(settings.ambient * settings.ambientColor.z, 0.3);
    EXPECT_EQ(settings.exponent, 8);
    EXPECT_FALSE(settings.transmission);
    EXPECT_EQ(settings.material.diffuse, 0.5);
    EXPECT_EQ(settings.material.back.exponent, 4);
    EXPECT_EQ(settings.reflectance, shading::Reflectance::Ward);
    EXPECT_EQ(settings.normals, shading::Normals::Smooth);
    EXPECT_EQ(settings.anisotropy.gamma, 60);
    EXPECT_TRUE(settings.shadows.on);
    EXPECT_EQ(settings.shadows.softness, 0.2);
    EXPECT_FALSE(settings.plain());
}

TEST(LightingFile, FaultsAreNamedOnOneLine) {
    const std::pair<const char*, const char*> faults[] = {
        {"{", "is not JSON"},
        {"[]", "must be an object"},
        {R"({"light": []})", "unknown key"},
        {R"({"lights": [{"towards": [0, 0, 1]}]})", "lights[0] has no type"},
        {R"({"lights": [{"type": "spot"}]})", "lights[0].type must be"},
        {R"({"lights": [{"type": "directional", "towards": [0, 0, 0]}]})", "has no direction"},
        {R"({"lights": [{"type": "point"}]})", "has no \"position\""},
        {R"({"lights": [{"type": "head", "attenuation": [0, 0, 0]}]})", "is all 0"},
        {R"({"lights": [{"type": "head", "color": [1, 1]}]})", "has 2 numbers"},
        {R"({"material": {"specular": -1}})", "must not be negative"},
        {R"({"material": {"phase_asymmetry": 1}})", "between -1 and 1"},
        {R"({"reflectance": "shiny"})", "there is no 'shiny'"},
        {R"({"anisotropy": {"radius": 0}})", "give a number from"},
        {R"({"anisotropy": {"reach": 1}})", "there is no 'reach'"},
        {R"({"shadows": 3})", "must be an object"}};
    for (const auto& [text, expected] : faults) {
        shading::ShadingSettings settings;
        try {
            parseLighting(text, "file.json", settings);
            ADD_FAILURE() << text << " was taken";
        } catch (const std::runtime_error& error) {
            const std::string message = error.what();
            EXPECT_NE(message.find(expected), std::string::npos) << message;
            EXPECT_EQ(message.find("file.json"), 0u) << message;
            EXPECT_EQ(message.find('\n'), std::string::npos);
        }
    }
}

}  // namespace
}  // namespace tetralux::projection
