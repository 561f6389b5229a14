// SPDX-License-Identifier: Apache-2.0
#include <projection/gl/gl_compute.h>

#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <projection/cells/cell_constants.h>

namespace tetralux::projection {
namespace {

constexpr std::size_t groupsAlongX = 32768;  // 65,535 is what OpenGL promises

std::vector<std::string_view> afterCommon(std::vector<std::string_view> files) {
    files.insert(files.begin(), "projection/gl/gl_compute.glsl");
    return files;
}

}  // namespace

GlDefines computeDefines(GlDefines defines) {
    const std::pair<const char*, double> constants[] = {
        {"largestPlane", largestPlane},           {"leastEyeCoordinate", leastEyeCoordinate},
        {"leastDeterminant", leastDeterminant},   {"unboundedPixel", unboundedPixel},
        {"unboundedKey", unboundedPixel},         {"leastDepth", leastDepth},
        {"nearestDepthShare", nearestDepthShare}, {"centroidDepthShare", centroidDepthShare},
        {"sharpestCorner", sharpestCorner},       {"farthestCorner", farthestCorner}};
    for (const auto& [name, value] : constants) defines.set(name, fmt::format("{:.17e}lf", value));
    defines.set("TETRALUX_GROUP", fmt::format("{}u", glGroup));
    defines.set("TETRALUX_SORT_BLOCK", fmt::format("{}u", glSortBlock));
    defines.set("TETRALUX_GROUPS_ALONG_X", fmt::format("{}u", groupsAlongX));
    return defines;
}

GlStorage::GlStorage(const GlFunctions& gl, std::size_t bytes, const void* data, GLenum usage) : gl_(gl) {
    GLint64 largest = 0;
    gl_.GetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &largest);
    if (bytes > static_cast<std::size_t>(std::max<GLint64>(largest, 0)))
        throw std::runtime_error(
            fmt::format("a buffer of {} bytes: shaders of this OpenGL renderer see {} at once; use --gl-path stream",
                        bytes, largest));
    gl_.GenBuffers(1, &buffer_);
    gl_.BindBuffer(GL_SHADER_STORAGE_BUFFER, buffer_);
    gl_.BufferData(GL_SHADER_STORAGE_BUFFER, static_cast<GLsizeiptr>(std::max<std::size_t>(bytes, 64)), nullptr, usage);
    if (data != nullptr) write(bytes, data);
    const GLenum error = gl_.GetError();
    if (error == GL_NO_ERROR) return;
    gl_.DeleteBuffers(1, &buffer_);
    throw std::runtime_error(
        fmt::format("a buffer of {} bytes: OpenGL error {:#06x}; use --gl-path stream", bytes, error));
}

void GlStorage::write(std::size_t bytes, const void* data) const {
    gl_.BindBuffer(GL_SHADER_STORAGE_BUFFER, buffer_);
    gl_.BufferSubData(GL_SHADER_STORAGE_BUFFER, 0, static_cast<GLsizeiptr>(bytes), data);
}

void GlStorage::read(std::size_t bytes, void* data) const {
    gl_.BindBuffer(GL_SHADER_STORAGE_BUFFER, buffer_);
    gl_.GetBufferSubData(GL_SHADER_STORAGE_BUFFER, 0, static_cast<GLsizeiptr>(bytes), data);
}

void bindStorage(const GlFunctions& gl, std::initializer_list<GLuint> buffers) {
    GLuint place = 0;
    for (const GLuint buffer : buffers) gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, place++, buffer);
}

GlKernel::GlKernel(const GlFunctions& gl, GlDefines defines, std::vector<std::string_view> files)
    : gl_(gl), program_(gl, computeDefines(std::move(defines)), {{GL_COMPUTE_SHADER, afterCommon(std::move(files))}}) {}

void GlKernel::set(const char* name, std::size_t value) const {
    gl_.Uniform1ui(uniform(name), static_cast<GLuint>(value));
}
void GlKernel::set(const char* name, const glm::dvec3& value) const {
    gl_.Uniform3d(uniform(name), value.x, value.y, value.z);
}
void GlKernel::set(const char* name, const glm::dvec4& value) const {
    gl_.Uniform4d(uniform(name), value.x, value.y, value.z, value.w);
}
void GlKernel::set(const char* name, double value) const {
    gl_.Uniform1d(uniform(name), value);
}

void GlKernel::run(std::size_t items) const {
    const std::size_t groups = (items + glGroup - 1) / glGroup, x = std::min(groups, groupsAlongX);
    if (groups == 0) return;
    gl_.DispatchCompute(static_cast<GLuint>(x), static_cast<GLuint>((groups + x - 1) / x), 1);
    gl_.MemoryBarrier(GL_ALL_BARRIER_BITS);
}

void GlKernel::runIndirect(std::size_t offset) const {
    gl_.DispatchComputeIndirect(static_cast<GLintptr>(offset));
    gl_.MemoryBarrier(GL_ALL_BARRIER_BITS);
}

}  // namespace tetralux::projection
