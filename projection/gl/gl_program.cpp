// SPDX-License-Identifier: Apache-2.0
#include <projection/gl/gl_program.h>

#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>

#include <projection/gl/gl_shader_text.h>

namespace tetralux::projection {
namespace {

// The driver's log on one line, as error messages are.
std::string oneLine(std::string log) {
    std::replace(log.begin(), log.end(), '\n', ' ');
    while (!log.empty() && (log.back() == ' ' || log.back() == '\0')) log.pop_back();
    return log;
}

std::string shaderSource(const GlDefines& defines, const GlShaderSource& source) {
    std::string text = "#version 430 core\n" + defines.text();
    int number = 0;
    for (const std::string_view file : source.files) {
        text += fmt::format("#line 1 {}\n{}\n", number++, glShaderText(file));  // the log says "number:line"
    }
    return text;
}

GLuint compileShader(const GlFunctions& gl, const GlDefines& defines, const GlShaderSource& source) {
    const std::string text = shaderSource(defines, source);
    const char* pointer = text.c_str();
    const GLuint shader = gl.CreateShader(source.stage);
    gl.ShaderSource(shader, 1, &pointer, nullptr);
    gl.CompileShader(shader);
    GLint compiled = GL_FALSE, length = 0;
    gl.GetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
    if (compiled == GL_TRUE) return shader;
    gl.GetShaderiv(shader, GL_INFO_LOG_LENGTH, &length);
    std::string log(static_cast<std::size_t>(std::max(length, 1)), '\0');
    gl.GetShaderInfoLog(shader, length, nullptr, log.data());
    gl.DeleteShader(shader);
    throw std::runtime_error(
        fmt::format("shader {}: the driver rejects it ({}); please report this with the driver's name",
                    source.files.back(), oneLine(log)));
}

}  // namespace

GlProgram::GlProgram(const GlFunctions& gl, const GlDefines& defines, const std::vector<GlShaderSource>& sources)
    : gl_(gl), program_(gl.CreateProgram()) {
    try {
        for (const GlShaderSource& source : sources) {
            const GLuint shader = compileShader(gl, defines, source);
            gl.AttachShader(program_, shader);
            gl.DeleteShader(shader);  // lives as long as the program
        }
        gl.LinkProgram(program_);
        GLint linked = GL_FALSE;
        gl.GetProgramiv(program_, GL_LINK_STATUS, &linked);
        if (linked != GL_TRUE) {
            std::string log(1024, '\0');
            GLsizei length = 0;
            gl.GetProgramInfoLog(program_, static_cast<GLsizei>(log.size()), &length, log.data());
            log.resize(static_cast<std::size_t>(length));
            throw std::runtime_error(
                fmt::format("shader program: the driver does not link it ({}); please report this with the "
                            "driver's name",
                            oneLine(log)));
        }
    } catch (...) {
        gl.DeleteProgram(program_);
        throw;
    }
}

GlProgram::~GlProgram() {
    gl_.DeleteProgram(program_);
}

}  // namespace tetralux::projection
