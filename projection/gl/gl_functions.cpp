// SPDX-License-Identifier: Apache-2.0
#include <projection/gl/gl_functions.h>

#include <stdexcept>

#include <fmt/format.h>

namespace tetralux::projection {

std::unique_ptr<GlFunctions> loadGlFunctions(const GlContext& context) {
    auto functions = std::make_unique<GlFunctions>();
    const int version = gladLoadGLContextUserPtr(
        functions.get(),
        [](void* user, const char* name) { return static_cast<const GlContext*>(user)->functionAddress(name); },
        const_cast<GlContext*>(&context));
    if (version < GLAD_MAKE_VERSION(4, 3)) {
        throw std::runtime_error(
            fmt::format("context {}: OpenGL {}.{} is too old; 4.3 is needed, which Mesa's llvmpipe has",
                        context.description(), GLAD_VERSION_MAJOR(version), GLAD_VERSION_MINOR(version)));
    }
    return functions;
}

void checkGl(const GlFunctions& gl, const char* step) {
    const GLenum error = gl.GetError();
    if (error == GL_NO_ERROR) return;
    const char* text = error == GL_OUT_OF_MEMORY ? "out of memory; a smaller image or mesh would fit"
                                                 : "refused; please report this with the renderer's name";
    throw std::runtime_error(fmt::format("OpenGL, {}: error {:#06x}, {}", step, error, text));
}

}  // namespace tetralux::projection
