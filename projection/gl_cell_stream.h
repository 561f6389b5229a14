// SPDX-License-Identifier: Apache-2.0
/// \file
/// Internal: projected cells on their way to OpenGL, a chunk at a time.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <vector>

#include <projection/cell_setup.h>
#include <projection/gl_cell_outline.h>
#include <projection/gl_functions.h>

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

/// How a shader finds vertices' attributes: the eye's barycentric coordinates (orthographic: their rates per rho) and
/// the point numbers.
struct CellCorners {
    float eyeWeight[4];
    std::uint32_t point[4];
};

/// Writes one cell at `target`, which has room for layout.floats() floats.
void writeCell(const GlCellLayout& layout, const CellOutline& outline, const CellRecord& record,
               const CellGradient& gradient, const CellCorners& corners, float* target);

/// Draws cells chunk by chunk while the next chunk is being written into the other buffer.
class GlCellStream {
public:
    GlCellStream(const GlFunctions& gl, GlCellLayout layout);
    ~GlCellStream();
    GlCellStream(const GlCellStream&) = delete;
    GlCellStream& operator=(const GlCellStream&) = delete;

    /// Writes the vertices of cells [begin, end) of the drawing order.
    using WriteCells = std::function<void(std::size_t begin, std::size_t end, float* target)>;

    /// Wall time of the calling thread, in milliseconds.
    struct Times {
        double setup = 0;   ///< waiting for cells to be written
        double upload = 0;  ///< mapping and unmapping buffers
        double draw = 0;    ///< in draw calls
    };

    /// Draws `cellCount` cells in order with the current program and blending.
    Times draw(std::size_t cellCount, const WriteCells& write);

private:
    struct Buffer {
        GLuint vertices = 0, vertexArray = 0;
    };
    float* map(const Buffer& buffer, std::size_t cells) const;

    const GlFunctions& gl_;
    GlCellLayout layout_;
    GLuint indices_ = 0;
    std::array<Buffer, 3> buffers_;
};

}  // namespace tetralux::projection
