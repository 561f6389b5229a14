// SPDX-License-Identifier: Apache-2.0
/// \file
/// Internal: pixel maps as textures of the cell program (gl_cell.frag).
#pragma once

#include <projection/cells/cell_setup.h>
#include <projection/core/pixel_maps.h>
#include <projection/gl/gl_functions.h>

namespace tetralux::projection {

/// Limits of each pixel's ray and normals of cuts. Inverse depth is zRef/z − 1, orthographic zRef − z, z the depth in
/// scene lengths; `depthReference` is zRef.
class GlLimits {
public:
    explicit GlLimits(const GlFunctions& gl);
    ~GlLimits();
    GlLimits(const GlLimits&) = delete;
    GlLimits& operator=(const GlLimits&) = delete;

    /// Uploads the maps of a frame: texels (nearest, farthest, factor of extinction, end of the cut's layer) and the
    /// cut's normals in world space.
    void upload(const PixelMaps& maps, const CameraFrame& frame, const SceneUnits& units, double depthReference);

    /// Binds limits to that texture unit and normals to the next.
    void bind(GLuint unit) const;

private:
    void store(GLuint texture, int width, int height, const std::vector<glm::vec4>& texels) const;

    const GlFunctions& gl_;
    GLuint textures_[2] = {0, 0};
};

}  // namespace tetralux::projection
