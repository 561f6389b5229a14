// SPDX-License-Identifier: Apache-2.0
#include <projection/gl/gl_limits.h>

#include <glm/geometric.hpp>

#include <projection/cells/ray_inverse_depth.h>

namespace tetralux::projection {

GlLimits::GlLimits(const GlFunctions& gl) : gl_(gl) {
    gl_.GenTextures(2, textures_);
}

GlLimits::~GlLimits() {
    gl_.DeleteTextures(2, textures_);
}

void GlLimits::store(GLuint texture, int width, int height, const std::vector<glm::vec4>& texels) const {
    gl_.BindTexture(GL_TEXTURE_2D, texture);
    gl_.TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA32F, width, height, 0, GL_RGBA, GL_FLOAT, texels.data());
    gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    gl_.BindTexture(GL_TEXTURE_2D, 0);
    checkGl(gl_, "pixel maps");
}

void GlLimits::upload(const PixelMaps& maps, const CameraFrame& frame, const SceneUnits& units, double depthReference) {
    const InverseDepthMaps rayInverseDepth = inverseDepthMaps(maps, frame, units, depthReference);
    const std::size_t count = static_cast<std::size_t>(frame.width) * static_cast<std::size_t>(frame.height);
    std::vector<glm::vec4> texels(count,
                                  glm::vec4(noInverseDepthLimit, -noInverseDepthLimit, 1.0f, noInverseDepthLimit)),
        normals(count);
    for (std::size_t i = 0; i < count; ++i) {
        if (!rayInverseDepth.nearest.empty()) texels[i].x = rayInverseDepth.nearest[i];
        if (!rayInverseDepth.farthest.empty()) texels[i].y = rayInverseDepth.farthest[i];
        if (!maps.extinctionScale.empty()) texels[i].z = maps.extinctionScale[i];
        if (maps.cutLayerEnd.empty()) continue;
        texels[i].w = rayInverseDepth.cutLayerEnd[i];
        normals[i] = glm::vec4(maps.cutNormal[i], 0.0f);
    }
    store(textures_[0], frame.width, frame.height, texels);
    store(textures_[1], frame.width, frame.height, normals);
}

void GlLimits::bind(GLuint unit) const {
    for (GLuint i = 0; i < 2; ++i) {
        gl_.ActiveTexture(GL_TEXTURE0 + unit + i);
        gl_.BindTexture(GL_TEXTURE_2D, textures_[i]);
    }
    gl_.ActiveTexture(GL_TEXTURE0);
}

}  // namespace tetralux::projection
