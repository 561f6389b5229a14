// SPDX-License-Identifier: Apache-2.0
/// \file
/// Options of `render` that say how the shape of the data shows, light apart: limits, classification, silhouettes,
/// isosurfaces, adaptive opacity.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <projection/core/clip_region.h>
#include <projection/core/scene.h>

namespace CLI {
class App;
}

namespace tetralux::apps {

struct ShapeOptions {
    std::vector<projection::HalfSpace> clips;
    std::optional<double> cutLayer;  ///< mesh units; nothing: projection::cutLayerShare
    std::string silhouette;          ///< "", "exact" or "approximate"
    std::optional<int> isosurfaces;  ///< so many instead of extinction
    bool unlit = false;              ///< those in their colour alone
    projection::AdaptiveSettings adaptive;
    bool adaptiveOn = false;
};

/// Adds them to `command`; parsing fills `options` and, where they are settings of the picture, `settings`.
void addShapeOptions(CLI::App& command, ShapeOptions& options, projection::RenderSettings& settings);

/// What has to be looked at together, after parsing. \throws std::runtime_error for what does not go together.
void finishShapeOptions(const ShapeOptions& options, projection::RenderSettings& settings);

/// The words of a command line with those option values joined that may be left out: "--silhouette exact" becomes
/// "--silhouette=exact".
std::vector<std::string> joinedOptionalValues(int argumentCount, char** arguments);

}  // namespace tetralux::apps
