// SPDX-License-Identifier: Apache-2.0
/// \file
/// Lights and materials as a JSON document, so that a command line need not hold them. Every key may be left out:
///
///     {"ambient": 0.1 or [r, g, b], "exponent": 32, "transmission": true,
///      "lights": [{"type": "directional", "towards": [x, y, z], "color": [r, g, b], "intensity": 1},
///                 {"type": "point", "position": [x, y, z], "attenuation": [constant, linear, quadratic]},
///                 {"type": "head"}],
///      "material": {"diffuse": 1, "specular": 1, "diffuse_transmission": 1, "specular_transmission": 1,
///                   "front": {"specular": [r, g, b], "exponent": 32}, "back": {…}, "phase_asymmetry": 0.3,
///                   "specular_by_gradient": false, true or "absolute"},
///      "reflectance": "phong", "normals": "cell",
///      "anisotropy": {"radius": 4, "interval": 0.05, "samples": 4, "smoothing": 0, "kappa": 0.2, "gamma": 10},
///      "shadows": true or {"softness": 0.1}}
///
/// "specular" of a side is C_spec, "specular" of the material k_s. "phase_asymmetry" makes Henyey and Greenstein's
/// phase function the diffuse part; without it that is Equation 19's.
#pragma once

#include <string>

#include <shading/lights.h>

namespace tetralux::projection {

/// Changes in `settings` what the document names; its lights are added to those there. `origin` is what messages call
/// it. \throws std::runtime_error naming origin, key, fault and remedy on one line
void parseLighting(const std::string& text, const std::string& origin, shading::ShadingSettings& settings);

/// The same of a file.
void readLighting(const std::string& path, shading::ShadingSettings& settings);

/// Sets how highlights are formed: "phong", "blinn-phong", "ward", "lafortune", "none", and "henyey-greenstein", which
/// is short for none with a phase function (of asymmetry 0.3 unless it has one). `what` begins the message. \throws
/// std::runtime_error listing the names there are
void setReflectance(const std::string& what, const std::string& name, shading::ShadingSettings& settings);

/// Checks and sets Material::phaseAsymmetry.
void setPhaseAsymmetry(const std::string& what, double asymmetry, shading::Material& material);

/// "cell", "smooth".
shading::Normals normalsOf(const std::string& what, const std::string& name);

/// Checks one parameter of AnisotropySettings by its key of the document, and sets it.
/// \throws std::runtime_error beginning with `what`
void setAnisotropyParameter(const std::string& what, const std::string& key, double value,
                            shading::AnisotropySettings& settings);

}  // namespace tetralux::projection
