// SPDX-License-Identifier: Apache-2.0
/// \file
/// What stands in the volume: --slice, --surface and how they look.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include <projection/opaque/boundary_surface.h>
#include <projection/opaque/opaque_objects.h>

namespace CLI {
class App;
}

namespace tetralux::apps {

struct OpaqueOptions {
    std::vector<projection::Slice> slices;
    std::vector<double> sliceOpacities;      ///< none, one for all, or one for each
    std::optional<int> isolines;             ///< so many on each slice
    projection::Isolines lines;              ///< how they look
    std::vector<std::string> surfaces;       ///< files
    std::vector<glm::dvec3> surfaceColors;   ///< none, one for all, or one for each
    std::vector<std::string> surfaceFields;  ///< of their own, as the colours; the same, "none": of that surface not
    bool flat = false;                       ///< surfaces without light
    bool boundary = false;                   ///< the mesh's own boundary
    projection::BoundaryLook boundaryLook;
};

/// "px,py,pz,nx,ny,nz"; the normal becomes one whose largest component is 1.
projection::Slice parseSlice(const std::string& option, const std::string& text);

void addOpaqueOptions(CLI::App& command, OpaqueOptions& options);

/// Reads the surfaces. \throws std::runtime_error naming the file or option.
projection::OpaqueObjects readOpaqueObjects(const OpaqueOptions& options);

}  // namespace tetralux::apps
