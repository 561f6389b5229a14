// SPDX-License-Identifier: Apache-2.0
#include <projection/gl/gl_frame_target.h>

#include <stdexcept>

#include <fmt/format.h>

namespace tetralux::projection {

GlFrameTarget::GlFrameTarget(const GlFunctions& gl) : gl_(gl) {
    gl_.GenFramebuffers(1, &framebuffer_);
}

GlFrameTarget::~GlFrameTarget() {
    gl_.DeleteFramebuffers(1, &framebuffer_);
    gl_.DeleteTextures(1, &texture_);
}

void GlFrameTarget::resize(int width, int height) {
    GLint largest = 0;
    gl_.GetIntegerv(GL_MAX_TEXTURE_SIZE, &largest);
    gl_.DeleteTextures(1, &texture_);
    texture_ = 0;
    width_ = height_ = 0;
    if (width <= largest && height <= largest) {
        gl_.GenTextures(1, &texture_);
        gl_.BindTexture(GL_TEXTURE_2D, texture_);
        gl_.TexStorage2D(GL_TEXTURE_2D, 1, GL_RGBA32F, width, height);
        gl_.BindTexture(GL_TEXTURE_2D, 0);
        gl_.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture_, 0);
    }
    if (texture_ == 0 || gl_.GetError() != GL_NO_ERROR ||
        gl_.CheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
        throw std::runtime_error(fmt::format(
            "image size {}x{}: this OpenGL renderer has no float target of that size; choose a smaller size "
            "or another engine",
            width, height));
    }
    width_ = width;
    height_ = height;
}

void GlFrameTarget::begin(int width, int height, float value) {
    gl_.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
    if (width != width_ || height != height_) resize(width, height);
    gl_.Viewport(0, 0, width, height);
    const float color[4] = {value, value, value, value};
    gl_.ClearBufferfv(GL_COLOR, 0, color);
}

Image GlFrameTarget::read() const {
    Image image(width_, height_);
    gl_.PixelStorei(GL_PACK_ALIGNMENT, 4);
    gl_.ReadPixels(0, 0, width_, height_, GL_RGBA, GL_FLOAT, image.pixels.data());
    checkGl(gl_, "reading the frame");
    return image;
}

}  // namespace tetralux::projection
