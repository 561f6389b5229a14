// SPDX-License-Identifier: Apache-2.0
#include <projection/gl_cell_stream.h>

#include <algorithm>
#include <chrono>
#include <cstring>
#include <stdexcept>

#include <tbb/task_group.h>

namespace tetralux::projection {
namespace {

// Cells per draw call: large enough that a call's fixed cost does not show, small enough that drawing begins early and
// a buffer (128 or 144 bytes a cell) stays in the cache. 32,768 take llvmpipe 3 % less than
// 8,192, but begin later.
constexpr std::size_t chunkCells = 16384;

constexpr std::size_t indicesPerCell = 6;

constexpr std::size_t slotBytes = 2 * sizeof(float);

double millisecondsSince(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

std::vector<GLuint> chunkIndices(std::size_t slots) {
    std::vector<GLuint> indices;
    indices.reserve(chunkCells * indicesPerCell);
    for (std::size_t cell = 0; cell < chunkCells; ++cell) {
        for (const std::size_t slot : {3, 0, 1, 3, 1, 2}) indices.push_back(static_cast<GLuint>(cell * slots + slot));
    }
    return indices;
}

}  // namespace

void writeCell(const GlCellLayout& layout, const CellOutline& outline, const CellRecord& record,
               const CellGradient& gradient, const CellCorners& cellCorners, float* target) {
    const glm::vec2 corners[4] = {outline[1], outline[2], outline[3], outline[0]};
    std::memcpy(target, corners, sizeof(corners));
    std::memcpy(target + 8, &record, sizeof(record));
    if (layout.gradient) std::memcpy(target + 32, &gradient, sizeof(gradient));
    if (layout.attributes) std::memcpy(target + 36, &cellCorners, sizeof(cellCorners));
}

GlCellStream::GlCellStream(const GlFunctions& gl, GlCellLayout layout) : gl_(gl), layout_(layout) {
    const std::vector<GLuint> indices = chunkIndices(layout_.slots());
    gl_.GenBuffers(1, &indices_);
    gl_.BindVertexArray(0);
    // Corners 1 to 3 of the last cell read beyond it as if a record followed: one cell more holds that.
    const std::size_t bufferBytes = (chunkCells + 1) * layout_.slots() * slotBytes;
    for (Buffer& buffer : buffers_) {
        gl_.GenVertexArrays(1, &buffer.vertexArray);
        gl_.BindVertexArray(buffer.vertexArray);
        gl_.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices_);
        gl_.GenBuffers(1, &buffer.vertices);
        gl_.BindBuffer(GL_ARRAY_BUFFER, buffer.vertices);
        gl_.BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(bufferBytes), nullptr, GL_STREAM_DRAW);
        const GLuint vectors = layout_.attributes ? 8 : layout_.gradient ? 7 : 6;
        const auto offset = [](std::size_t bytes) { return reinterpret_cast<const void*>(bytes); };
        gl_.EnableVertexAttribArray(0);
        gl_.VertexAttribPointer(0, 2, GL_FLOAT, GL_FALSE, slotBytes, nullptr);
        for (GLuint i = 0; i < vectors; ++i) {
            gl_.EnableVertexAttribArray(1 + i);
            gl_.VertexAttribPointer(1 + i, 4, GL_FLOAT, GL_FALSE, slotBytes, offset(slotBytes + i * 4 * sizeof(float)));
        }
        if (layout_.attributes) {
            gl_.EnableVertexAttribArray(1 + vectors);
            gl_.VertexAttribIPointer(1 + vectors, 4, GL_UNSIGNED_INT, slotBytes,
                                     offset(slotBytes + vectors * 4 * sizeof(float)));
        }
    }
    gl_.BufferData(GL_ELEMENT_ARRAY_BUFFER, static_cast<GLsizeiptr>(indices.size() * sizeof(GLuint)), indices.data(),
                   GL_STATIC_DRAW);
    gl_.BindVertexArray(0);
    checkGl(gl_, "vertex buffers");
}

GlCellStream::~GlCellStream() {
    for (Buffer& buffer : buffers_) {
        gl_.DeleteVertexArrays(1, &buffer.vertexArray);
        gl_.DeleteBuffers(1, &buffer.vertices);
    }
    gl_.DeleteBuffers(1, &indices_);
}

float* GlCellStream::map(const Buffer& buffer, std::size_t cells) const {
    gl_.BindBuffer(GL_ARRAY_BUFFER, buffer.vertices);
    void* target = gl_.MapBufferRange(GL_ARRAY_BUFFER, 0, static_cast<GLsizeiptr>(cells * layout_.slots() * slotBytes),
                                      GL_MAP_WRITE_BIT | GL_MAP_INVALIDATE_BUFFER_BIT);
    if (target == nullptr)
        throw std::runtime_error("OpenGL: no memory for a vertex buffer; close other programs that draw");
    return static_cast<float*>(target);
}

GlCellStream::Times GlCellStream::draw(std::size_t cellCount, const WriteCells& write) {
    Times times;
    tbb::task_group writing;
    gl_.ProvokingVertex(GL_FIRST_VERTEX_CONVENTION);
    const auto start = [&](std::size_t begin) {
        const auto before = std::chrono::steady_clock::now();
        const std::size_t end = std::min(begin + chunkCells, cellCount);
        float* target = map(buffers_[begin / chunkCells % buffers_.size()], end - begin);
        times.upload += millisecondsSince(before);
        writing.run([&write, begin, end, target] { write(begin, end, target); });
    };
    if (cellCount > 0) start(0);
    for (std::size_t begin = 0; begin < cellCount; begin += chunkCells) {
        const auto waiting = std::chrono::steady_clock::now();
        writing.wait();
        times.setup += millisecondsSince(waiting);

        const auto unmapping = std::chrono::steady_clock::now();
        const Buffer& buffer = buffers_[begin / chunkCells % buffers_.size()];
        gl_.BindBuffer(GL_ARRAY_BUFFER, buffer.vertices);
        gl_.UnmapBuffer(GL_ARRAY_BUFFER);
        times.upload += millisecondsSince(unmapping);
        if (begin + chunkCells < cellCount) start(begin + chunkCells);

        const auto drawing = std::chrono::steady_clock::now();
        const std::size_t cells = std::min(chunkCells, cellCount - begin);
        gl_.BindVertexArray(buffer.vertexArray);
        gl_.DrawElements(GL_TRIANGLES, static_cast<GLsizei>(cells * indicesPerCell), GL_UNSIGNED_INT, nullptr);
        gl_.Flush();  // software renderers begin to fill pixels at a flush, in threads of their own
        times.draw += millisecondsSince(drawing);
    }
    gl_.BindVertexArray(0);
    return times;
}

}  // namespace tetralux::projection
