// SPDX-License-Identifier: Apache-2.0
/// \file
/// Internal: shader programs and other OpenGL objects that clean up after themselves. Their context must be current
/// when they are made, used and destroyed.
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <projection/gl_functions.h>

namespace tetralux::projection {

/// #define lines of one variant: (name, value).
using GlDefines = std::vector<std::pair<std::string, int>>;

struct GlShaderSource {
    GLenum stage;
    std::vector<std::string_view> files;  ///< embedded texts, concatenated in this order
};

class GlProgram {
public:
    /// Compiles and links. \throws std::runtime_error with the driver's message when that fails.
    GlProgram(const GlFunctions& gl, const GlDefines& defines, std::initializer_list<GlShaderSource> sources);
    ~GlProgram();
    GlProgram(const GlProgram&) = delete;
    GlProgram& operator=(const GlProgram&) = delete;

    void use() const { gl_.UseProgram(program_); }
    /// Location of a uniform; −1, which OpenGL ignores, where the variant does not use it.
    GLint uniform(const char* name) const { return gl_.GetUniformLocation(program_, name); }

private:
    const GlFunctions& gl_;
    GLuint program_ = 0;
};

}  // namespace tetralux::projection
