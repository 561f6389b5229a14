// SPDX-License-Identifier: Apache-2.0
/// \file
/// What `tetralux render` is asked for.
#pragma once

#include <optional>
#include <string>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <apps/annotation.h>
#include <apps/opaque_options.h>
#include <apps/options/camera_options.h>
#include <apps/options/color_options.h>
#include <apps/options/time_options.h>
#include <apps/shape_options.h>
#include <mesh/io/read_mesh.h>
#include <mesh/soup/mesh_shaping.h>
#include <projection/core/engine.h>
#include <projection/core/scene.h>
#include <projection/image/image_output.h>

namespace CLI {
class App;
}

namespace tetralux::apps {

struct RenderOptions {
    std::string source;  ///< mesh file or generated field
    std::string scalar;  ///< empty: the first field
    mesh::ReadOptions read;
    mesh::MeshShaping shaping;
    TimeOptions time;
    bool checkInterfaces = false;  ///< also where it takes long: whether cells overlap or do not fit together
    ColorOptions colors;
    projection::RenderSettings settings;
    OpaqueOptions opaque;
    AnnotationOptions annotation;
    ShapeOptions shape;
    projection::EngineOptions engine;

    CameraOptions camera;

    std::string output;                                  ///< .png or .exr
    std::optional<int> frames;                           ///< an orbit of so many images
    double previewMilliseconds = 0.0;                    ///< > 0: a quick picture in this time comes first
    std::optional<std::optional<glm::vec3>> background;  ///< not given: what suits the mode
    projection::PngOutput png;
    int verifiedPixels = 0;          ///< so many pixels of each frame are computed again by the reference
    std::optional<double> maxError;  ///< largest rmse that may be found so, its 95 % bound that is
    std::string keptAnisotropy;      ///< .vtu that the mesh is written to with its anisotropy; empty: none
    std::string report;              ///< JSON file; empty: none
    bool quiet = false;
};

/// Adds render's options to `command`; parsing fills `options`.
void addRenderOptions(CLI::App& command, RenderOptions& options);

}  // namespace tetralux::apps
