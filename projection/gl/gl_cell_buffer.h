// SPDX-License-Identifier: Apache-2.0
/// \file
/// Internal: projected cells as OpenGL's vertices, whoever writes them.
#pragma once

#include <cstddef>
#include <cstdint>

#include <projection/cells/cell_setup.h>
#include <projection/gl/gl_cell_outline.h>
#include <projection/gl/gl_functions.h>

namespace tetralux::projection {

/// What one cell takes of the vertex buffer. Vertices are 8 bytes apart and every attribute is read at that stride, so
/// that a record need not stand three or four times: cell i owns `slots` strides,
///
///     slot     0         1         2         3         4 … 15      16, 17 (only with gradients)   18 … 21 (only with
///     attributes)
///              corner 1  corner 2  corner 3  corner 0  CellRecord  CellGradient                  CellCorners
///
/// and the attributes that follow corner 0 are that record. Triangles (0, 1, 2) and (0, 2, 3) take their flat inputs
/// from their first vertex, corner 0; what the other corners read as a record is never looked at.
struct GlCellLayout {
    bool gradient = false;
    bool attributes = false;  ///< of vertices; only with gradients
    std::size_t slots() const { return attributes ? 22 : gradient ? 18 : 16; }
    std::size_t floats() const { return 2 * slots(); }
};

/// How a shader finds vertices' attributes: the eye's barycentric coordinates (orthographic: their rates per
/// inverseDepth) and the point numbers.
struct CellCorners {
    float eyeWeight[4];
    std::uint32_t point[4];
};

/// Writes one cell at `target`, which has room for layout.floats() floats.
void writeCell(const GlCellLayout& layout, const CellOutline& outline, const CellRecord& record,
               const CellGradient& gradient, const CellCorners& corners, float* target);

/// Indices of so many cells' triangles.
class GlCellIndices {
public:
    static constexpr std::size_t perCell = 6;

    GlCellIndices(const GlFunctions& gl, GlCellLayout layout, std::size_t cells);
    ~GlCellIndices() { gl_.DeleteBuffers(1, &buffer_); }
    GlCellIndices(const GlCellIndices&) = delete;
    GlCellIndices& operator=(const GlCellIndices&) = delete;
    GLuint name() const { return buffer_; }

private:
    const GlFunctions& gl_;
    GLuint buffer_ = 0;
};

/// Room for the vertices of so many cells, and the vertex array that reads them.
class GlCellBuffer {
public:
    GlCellBuffer(const GlFunctions& gl, GlCellLayout layout, std::size_t cells, const GlCellIndices& indices,
                 GLenum usage);
    ~GlCellBuffer();
    GlCellBuffer(const GlCellBuffer&) = delete;
    GlCellBuffer& operator=(const GlCellBuffer&) = delete;

    GLuint vertices() const { return vertices_; }
    GLuint vertexArray() const { return vertexArray_; }

private:
    const GlFunctions& gl_;
    GLuint vertices_ = 0, vertexArray_ = 0;
};

}  // namespace tetralux::projection
