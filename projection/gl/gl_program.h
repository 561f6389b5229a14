// SPDX-License-Identifier: Apache-2.0
/// \file
/// Internal: shader programs and other OpenGL objects that clean up after themselves. Their context must be current
/// when they are made, used and destroyed.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include <projection/gl/gl_functions.h>

namespace tetralux::projection {

/// #define lines of one variant: names and values as text.
class GlDefines {
public:
    void set(const char* name, int value) { text_ += fmt::format("#define {} {}\n", name, value); }
    void set(const char* name, double value) { text_ += fmt::format("#define {} {:.9e}\n", name, value); }
    void set(const char* name, const std::string& value) { text_ += fmt::format("#define {} {}\n", name, value); }
    const std::string& text() const { return text_; }

private:
    std::string text_;
};

struct GlShaderSource {
    GLenum stage;
    std::vector<std::string_view> files;  ///< embedded texts, concatenated in this order
};

class GlProgram {
public:
    /// Compiles and links. \throws std::runtime_error with the driver's message when that fails.
    GlProgram(const GlFunctions& gl, const GlDefines& defines, const std::vector<GlShaderSource>& sources);
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
