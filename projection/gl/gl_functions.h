// SPDX-License-Identifier: Apache-2.0
/// \file
/// Internal: the OpenGL function table. Only gl_*.cpp includes this header; no public header does.
#pragma once

#include <cstddef>
#include <memory>

#include <glad/gl.h>

#include <projection/gl/gl_context.h>

namespace tetralux::projection {

/// OpenGL's functions as members: gl.DrawArrays(…).
using GlFunctions = GladGLContext;

/// The functions of a context that is current. \throws std::runtime_error when it has less than OpenGL 4.3.
std::unique_ptr<GlFunctions> loadGlFunctions(const GlContext& context);

/// A place in the buffer that is bound, as OpenGL takes it.
inline const void* bufferOffset(std::size_t bytes) {
    return reinterpret_cast<const void*>(bytes);  // NOLINT(performance-no-int-to-ptr): so the interface has it
}

/// \throws std::runtime_error naming `step` and the error when OpenGL has recorded one.
void checkGl(const GlFunctions& gl, const char* step);

}  // namespace tetralux::projection
