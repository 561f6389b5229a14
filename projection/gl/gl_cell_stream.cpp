// SPDX-License-Identifier: Apache-2.0
#include <projection/gl/gl_cell_stream.h>

#include <algorithm>
#include <chrono>
#include <stdexcept>

#include <tbb/task_group.h>

namespace tetralux::projection {
namespace {

// Cells per draw call: large enough that a call's fixed cost does not show, small enough that drawing begins early and
// a buffer (128 or 144 bytes a cell) stays in the cache. 32,768 take llvmpipe 3 % less than
// 8,192, but begin later.
constexpr std::size_t chunkCells = 16384;

double millisecondsSince(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

GlCellStream::GlCellStream(const GlFunctions& gl, GlCellLayout layout)
    : gl_(gl), layout_(layout), indices_(gl, layout, chunkCells) {
    for (auto& buffer : buffers_)
        buffer = std::make_unique<GlCellBuffer>(gl, layout, chunkCells, indices_, GL_STREAM_DRAW);
}

float* GlCellStream::map(const GlCellBuffer& buffer, std::size_t cells) const {
    gl_.BindBuffer(GL_ARRAY_BUFFER, buffer.vertices());
    void* target =
        gl_.MapBufferRange(GL_ARRAY_BUFFER, 0, static_cast<GLsizeiptr>(cells * layout_.floats() * sizeof(float)),
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
        float* target = map(*buffers_[begin / chunkCells % buffers_.size()], end - begin);
        times.upload += millisecondsSince(before);
        writing.run([&write, begin, end, target] { write(begin, end, target); });
    };
    if (cellCount > 0) start(0);
    for (std::size_t begin = 0; begin < cellCount; begin += chunkCells) {
        const auto waiting = std::chrono::steady_clock::now();
        writing.wait();
        times.setup += millisecondsSince(waiting);

        const auto unmapping = std::chrono::steady_clock::now();
        const GlCellBuffer& buffer = *buffers_[begin / chunkCells % buffers_.size()];
        gl_.BindBuffer(GL_ARRAY_BUFFER, buffer.vertices());
        gl_.UnmapBuffer(GL_ARRAY_BUFFER);
        times.upload += millisecondsSince(unmapping);
        if (begin + chunkCells < cellCount) start(begin + chunkCells);

        const auto drawing = std::chrono::steady_clock::now();
        const std::size_t cells = std::min(chunkCells, cellCount - begin);
        gl_.BindVertexArray(buffer.vertexArray());
        gl_.DrawElements(GL_TRIANGLES, static_cast<GLsizei>(cells * GlCellIndices::perCell), GL_UNSIGNED_INT, nullptr);
        gl_.Flush();  // software renderers begin to fill pixels at a flush, in threads of their own
        times.draw += millisecondsSince(drawing);
    }
    gl_.BindVertexArray(0);
    return times;
}

}  // namespace tetralux::projection
