// SPDX-License-Identifier: Apache-2.0
/// \file
/// Internal: projected cells on their way to OpenGL, a chunk at a time.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <memory>

#include <projection/gl/gl_cell_buffer.h>

namespace tetralux::projection {

/// Draws cells chunk by chunk while the next chunk is being written into the other buffer.
class GlCellStream {
public:
    GlCellStream(const GlFunctions& gl, GlCellLayout layout);
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
    float* map(const GlCellBuffer& buffer, std::size_t cells) const;

    const GlFunctions& gl_;
    GlCellLayout layout_;
    GlCellIndices indices_;
    std::array<std::unique_ptr<GlCellBuffer>, 3> buffers_;
};

}  // namespace tetralux::projection
