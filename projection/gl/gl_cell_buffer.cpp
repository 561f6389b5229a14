// SPDX-License-Identifier: Apache-2.0
#include <projection/gl/gl_cell_buffer.h>

#include <cstring>
#include <vector>

namespace tetralux::projection {
namespace {

constexpr std::size_t slotBytes = 2 * sizeof(float);

}  // namespace

void writeCell(const GlCellLayout& layout, const CellOutline& outline, const CellRecord& record,
               const CellGradient& gradient, const CellCorners& cellCorners, float* target) {
    const glm::vec2 corners[4] = {outline[1], outline[2], outline[3], outline[0]};
    std::memcpy(target, corners, sizeof(corners));
    std::memcpy(target + 8, &record, sizeof(record));
    if (layout.gradient) std::memcpy(target + 32, &gradient, sizeof(gradient));
    if (layout.attributes) std::memcpy(target + 36, &cellCorners, sizeof(cellCorners));
}

GlCellIndices::GlCellIndices(const GlFunctions& gl, GlCellLayout layout, std::size_t cells) : gl_(gl) {
    std::vector<GLuint> indices;
    indices.reserve(cells * perCell);
    for (std::size_t cell = 0; cell < cells; ++cell)
        for (const std::size_t slot : {3, 0, 1, 3, 1, 2})
            indices.push_back(static_cast<GLuint>(cell * layout.slots() + slot));
    gl_.BindVertexArray(0);
    gl_.GenBuffers(1, &buffer_);
    gl_.BindBuffer(GL_COPY_WRITE_BUFFER, buffer_);
    gl_.BufferData(GL_COPY_WRITE_BUFFER, static_cast<GLsizeiptr>(indices.size() * sizeof(GLuint)), indices.data(),
                   GL_STATIC_DRAW);
    checkGl(gl_, "indices of cells");
}

GlCellBuffer::GlCellBuffer(const GlFunctions& gl, GlCellLayout layout, std::size_t cells, const GlCellIndices& indices,
                           GLenum usage)
    : gl_(gl) {
    gl_.GenVertexArrays(1, &vertexArray_);
    gl_.BindVertexArray(vertexArray_);
    gl_.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices.name());
    gl_.GenBuffers(1, &vertices_);
    gl_.BindBuffer(GL_ARRAY_BUFFER, vertices_);
    // Corners 1 to 3 of the last cell read beyond it as if a record followed: one cell more holds that.
    gl_.BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>((cells + 1) * layout.slots() * slotBytes), nullptr, usage);
    const GLuint vectors = layout.attributes ? 8 : layout.gradient ? 7 : 6;
    const auto vector = [](GLuint i) { return bufferOffset(slotBytes + std::size_t{i} * 4 * sizeof(float)); };
    gl_.EnableVertexAttribArray(0);
    gl_.VertexAttribPointer(0, 2, GL_FLOAT, GL_FALSE, slotBytes, nullptr);
    for (GLuint i = 0; i < vectors; ++i) {
        gl_.EnableVertexAttribArray(1 + i);
        gl_.VertexAttribPointer(1 + i, 4, GL_FLOAT, GL_FALSE, slotBytes, vector(i));
    }
    if (layout.attributes) {
        gl_.EnableVertexAttribArray(1 + vectors);
        gl_.VertexAttribIPointer(1 + vectors, 4, GL_UNSIGNED_INT, slotBytes, vector(vectors));
    }
    gl_.BindVertexArray(0);
    checkGl(gl_, "vertex buffers");
}

GlCellBuffer::~GlCellBuffer() {
    gl_.DeleteVertexArrays(1, &vertexArray_);
    gl_.DeleteBuffers(1, &vertices_);
}

}  // namespace tetralux::projection
