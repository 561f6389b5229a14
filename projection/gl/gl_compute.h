// SPDX-License-Identifier: Apache-2.0
/// \file
/// Internal: storage buffers and compute shaders of the resident path (gl_resident_cells.h).
#pragma once

#include <cstddef>
#include <initializer_list>
#include <vector>

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <projection/gl/gl_program.h>

namespace tetralux::projection {

/// A buffer on the GPU that shaders read and write.
class GlStorage {
public:
    /// `data` may be nullptr. \throws std::runtime_error when a shader may not see that many bytes at once.
    GlStorage(const GlFunctions& gl, std::size_t bytes, const void* data, GLenum usage);
    ~GlStorage() { gl_.DeleteBuffers(1, &buffer_); }
    GlStorage(const GlStorage&) = delete;
    GlStorage& operator=(const GlStorage&) = delete;

    /// Of anything that lies in one piece: a vector, a shared array.
    template <class Values>
    static GlStorage of(const GlFunctions& gl, const Values& values) {
        return GlStorage(gl, values.size() * sizeof(*values.data()), values.data(), GL_STATIC_DRAW);
    }

    GLuint name() const { return buffer_; }
    void write(std::size_t bytes, const void* data) const;
    void read(std::size_t bytes, void* data) const;

private:
    const GlFunctions& gl_;
    GLuint buffer_ = 0;
};

/// Binds buffers to the storage binding points 0, 1, …
void bindStorage(const GlFunctions& gl, std::initializer_list<GLuint> buffers);

/// Lanes of a group, cells of a block of the radix sort.
inline constexpr unsigned glGroup = 256, glSortBlock = 2048;

/// With the constants that gl_compute.glsl and the shared texts of cells ask for.
GlDefines computeDefines(GlDefines defines);

/// A compute shader; its buffers' binding points are counted from 0, which is the frame's plan (gl_compute.glsl).
class GlKernel {
public:
    /// `files`: what comes after projection/gl/gl_compute.glsl.
    GlKernel(const GlFunctions& gl, GlDefines defines, std::vector<std::string_view> files);

    void use() const { program_.use(); }
    GLint uniform(const char* name) const { return program_.uniform(name); }
    void set(const char* name, std::size_t value) const;  ///< of the program in use
    void set(const char* name, const glm::dvec3& value) const;
    void set(const char* name, const glm::dvec4& value) const;
    void set(const char* name, double value) const;

    /// Runs one lane per item, and makes what it wrote visible to what comes after.
    void run(std::size_t items) const;

    /// The same for as many groups as the plan says at that byte.
    void runIndirect(std::size_t offset) const;

private:
    const GlFunctions& gl_;
    GlProgram program_;
};

}  // namespace tetralux::projection
