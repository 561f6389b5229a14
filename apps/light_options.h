// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <shading/lights.h>

namespace CLI {
class App;
}

namespace tetralux::apps {

/// Adds the options of lights, materials, normals and shadows to `command`; parsing fills `settings`.
void addLightOptions(CLI::App& command, shading::ShadingSettings& settings);

}  // namespace tetralux::apps
