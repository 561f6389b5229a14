// SPDX-License-Identifier: Apache-2.0
/// \file
/// Internal: the framebuffer that cells are blended into.
#pragma once

#include <projection/gl/gl_functions.h>
#include <projection/image/image.h>

namespace tetralux::projection {

/// An RGBA32F framebuffer: blending into half floats or bytes loses up to 0.2 and 0.9 of the opacity of 2,000 thin
/// layers. Its row 0 is the image's top row.
class GlFrameTarget {
public:
    explicit GlFrameTarget(const GlFunctions& gl);
    ~GlFrameTarget();
    GlFrameTarget(const GlFrameTarget&) = delete;
    GlFrameTarget& operator=(const GlFrameTarget&) = delete;

    /// Binds it for drawing at that size, cleared to `value` in all channels.
    /// \throws std::runtime_error when the renderer has no target of that size.
    void begin(int width, int height, float value);

    GLuint texture() const { return texture_; }  ///< of the last begin()

    /// Waits for all drawing and reads the pixels.
    Image read() const;

private:
    void resize(int width, int height);

    const GlFunctions& gl_;
    GLuint framebuffer_ = 0, texture_ = 0;
    int width_ = 0, height_ = 0;
};

}  // namespace tetralux::projection
