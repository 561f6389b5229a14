// SPDX-License-Identifier: Apache-2.0
/// \file
/// Internal: the shader program of one scene and kind of camera, with all that it reads: table texture,
/// discontinuities, lights.
#pragma once

#include <memory>

#include <preint/preintegration_table.h>
#include <projection/cells/cell_setup.h>
#include <projection/core/camera.h>
#include <projection/core/scene.h>
#include <projection/core/transfer_support.h>
#include <projection/gl/gl_program.h>
#include <projection/gl/gl_walk.h>
#include <projection/light/light_frame.h>

namespace tetralux::projection {

/// Whether the mode looks segments up in a table.
bool modeLooksUp(Mode mode);

/// Texture units of a frame.
inline constexpr GLuint tableUnit = 0, vertexLightUnit = 1, limitsUnit = 2;  ///< limits take two: gl_limits.h

/// The kinds of frames that a scene may ask for.
struct GlFrameKind {
    bool orthographic = false;
    bool clipped = false;  ///< within pixel maps
    bool tiles = false;    ///< by compute tiles (gl_tiles.h)
};

/// A pre-integration table as a texture, 2D or 3D, zones stacked along its rows.
class GlTableTexture {
public:
    /// \throws std::runtime_error when the renderer has no texture of that size.
    GlTableTexture(const GlFunctions& gl, const preint::PreintegrationTable& table);
    /// What stands in for it.
    GlTableTexture(const GlFunctions& gl, const WalkedPieces& pieces);
    ~GlTableTexture() { gl_.DeleteTextures(1, &texture_); }
    GlTableTexture(const GlTableTexture&) = delete;
    GlTableTexture& operator=(const GlTableTexture&) = delete;

    void bind(GLuint unit) const;

private:
    void make(GLsizei columns, GLsizei rows, GLsizei slices, const std::vector<glm::vec4>& texels);

    const GlFunctions& gl_;
    GLenum target_;
    GLuint texture_ = 0;
};

/// What vertices carry for light, as a buffer that shaders read by point number.
class GlVertexLight {
public:
    /// \throws std::runtime_error when the renderer has no buffer of that size.
    GlVertexLight(const GlFunctions& gl, const shading::VertexLight& light);
    ~GlVertexLight();
    GlVertexLight(const GlVertexLight&) = delete;
    GlVertexLight& operator=(const GlVertexLight&) = delete;

    void bind(GLuint unit) const;

private:
    const GlFunctions& gl_;
    GLuint buffer_ = 0, texture_ = 0;
};

class GlCellProgram {
public:
    /// `function` and `table` in scene units; `table` may be null for modes without. `walked`: what is walked along in
    /// its stead, or null. `linearSampler`: the texture unit interpolates (gl_sampler_probe.h), else the shader does.
    GlCellProgram(const GlFunctions& gl, const RenderSettings& settings, const shading::VertexLight& vertexLight,
                  const preint::TransferFunction& function, const preint::PreintegrationTable* table,
                  const WalkedPieces* walked, GlFrameKind kind, bool linearSampler);

    /// Makes it current for drawing from that camera.
    void use(const CameraFrame& frame, double depthReference) const;

    /// Makes it current again, with all that use() and setLights() have set.
    void resume() const { program_.use(); }

    /// Of compute tiles, after use(): `cellFloats` of each cell's vertices; pixels whose transmittance is below the
    /// least are finished.
    void setTiles(const CameraFrame& frame, std::size_t cellFloats, float leastTransmittance) const;

    /// The lights of that camera, for programs of light in full; after use().
    void setLights(const std::vector<FrameLight>& lights, const SceneUnits& units) const;

    /// Where depth-based colouring begins and ends; after use().
    void setDepthRange(const DepthRange& range, double depthReference, const SceneUnits& units) const;

private:
    void setConstants(const RenderSettings& settings, const std::vector<ShownScalars>& support,
                      const preint::PreintegrationTable* table, const WalkedPieces* walked) const;

    void setLightModel(const shading::ShadingSettings& shading) const;

    const GlFunctions& gl_;
    GlProgram program_;
    GLint ndcPerPixel_, centre_, viewForward_, viewRight_, viewDown_, rowShape_, depthReference_, depthOrigin_,
        lightPlace_, lightFade_;
};

}  // namespace tetralux::projection
