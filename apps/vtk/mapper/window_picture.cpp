// SPDX-License-Identifier: Apache-2.0
#include "window_picture.h"

#include "vtkNew.h"
#include "vtkOpenGLFramebufferObject.h"
#include "vtkOpenGLQuadHelper.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLShaderCache.h"
#include "vtkOpenGLState.h"
#include "vtkShaderProgram.h"
#include "vtkTextureObject.h"
#include "vtk_glew.h"

namespace tetralux::vtk {

std::vector<float> windowDepths(vtkOpenGLRenderWindow& window, const WindowPart& part) {
    std::vector<float> depths(static_cast<std::size_t>(part.width) * static_cast<std::size_t>(part.height), 1.0F);
    window.GetZbufferData(part.left, part.bottom, part.left + part.width - 1, part.bottom + part.height - 1,
                          depths.data());
    return depths;
}

namespace {

constexpr const char* composition =
    "//VTK::System::Dec\n//VTK::Output::Dec\n"
    "in vec2 texCoord;\nuniform sampler2D volume;\nuniform sampler2D below;\n"
    "void main() {\n"
    "  vec4 color = texture2D(volume, texCoord);\n"
    "  gl_FragData[0] = color + (1.0 - color.a) * texture2D(below, texCoord);\n"
    "}\n";

void prepare(vtkTextureObject& texture, vtkOpenGLRenderWindow& window) {
    texture.SetContext(&window);
    texture.SetMinificationFilter(vtkTextureObject::Nearest);
    texture.SetMagnificationFilter(vtkTextureObject::Nearest);
}

}  // namespace

struct WindowPicture::Resources {
    vtkNew<vtkTextureObject> volume;
    vtkNew<vtkTextureObject> below;  ///< what the window showed
    vtkNew<vtkOpenGLFramebufferObject> copy;
    std::unique_ptr<vtkOpenGLQuadHelper> quad;

    void takeBelow(vtkOpenGLRenderWindow& window, const WindowPart& part);
};

/// Copies the part of the framebuffer that is drawn into, of whatever kind it is.
void WindowPicture::Resources::takeBelow(vtkOpenGLRenderWindow& window, const WindowPart& part) {
    const auto width = static_cast<unsigned>(part.width), height = static_cast<unsigned>(part.height);
    prepare(*below, window);
    if (below->GetHandle() == 0 || below->GetWidth() != width || below->GetHeight() != height) {
        below->SetInternalFormat(GL_RGBA16F);
        below->SetDataType(GL_FLOAT);
        below->Allocate2D(width, height, 4, VTK_FLOAT);
    }
    vtkOpenGLState* state = window.GetState();
    const vtkOpenGLState::ScopedglEnableDisable scissor(state, GL_SCISSOR_TEST);
    state->vtkglDisable(GL_SCISSOR_TEST);
    GLint drawn = 0;
    glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &drawn);
    copy->SetContext(&window);
    state->PushFramebufferBindings();
    copy->Bind(GL_DRAW_FRAMEBUFFER);
    copy->AddColorAttachment(0, below);
    copy->ActivateDrawBuffer(0);
    state->vtkglBindFramebuffer(GL_READ_FRAMEBUFFER, static_cast<unsigned>(drawn));
    state->vtkglBlitFramebuffer(part.left, part.bottom, part.left + part.width, part.bottom + part.height, 0, 0,
                                part.width, part.height, GL_COLOR_BUFFER_BIT, GL_NEAREST);
    state->PopFramebufferBindings();
}

WindowPicture::WindowPicture() : resources_(std::make_unique<Resources>()) {}
WindowPicture::~WindowPicture() = default;

void WindowPicture::show(vtkOpenGLRenderWindow& window, const WindowPart& part, const float* rgba) {
    vtkTextureObject* volume = resources_->volume;
    vtkTextureObject* below = resources_->below;
    resources_->takeBelow(window, part);
    prepare(*volume, window);
    volume->Create2DFromRaw(static_cast<unsigned>(part.width), static_cast<unsigned>(part.height), 4, VTK_FLOAT,
                            const_cast<float*>(rgba));  // NOLINT: VTK reads it
    volume->Activate();
    below->Activate();
    if (!resources_->quad)
        resources_->quad = std::make_unique<vtkOpenGLQuadHelper>(&window, nullptr, composition, "");
    else
        window.GetShaderCache()->ReadyShaderProgram(resources_->quad->Program);
    vtkOpenGLState* state = window.GetState();
    {
        const vtkOpenGLState::ScopedglEnableDisable depthTest(state, GL_DEPTH_TEST), blend(state, GL_BLEND);
        const vtkOpenGLState::ScopedglDepthMask depthMask(state);
        state->vtkglDisable(GL_DEPTH_TEST);
        state->vtkglDepthMask(GL_FALSE);
        state->vtkglDisable(GL_BLEND);  // software blends in eight bits, which is off by 1.5/255
        resources_->quad->Program->SetUniformi("volume", volume->GetTextureUnit());
        resources_->quad->Program->SetUniformi("below", below->GetTextureUnit());
        resources_->quad->Render();
    }
    below->Deactivate();
    volume->Deactivate();
}

void WindowPicture::release(vtkWindow* window) {
    resources_->volume->ReleaseGraphicsResources(window);
    resources_->below->ReleaseGraphicsResources(window);
    resources_->copy->ReleaseGraphicsResources(window);
    resources_->quad.reset();
}

}  // namespace tetralux::vtk
