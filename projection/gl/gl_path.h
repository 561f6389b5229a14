// SPDX-License-Identifier: Apache-2.0
/// \file
/// Who sets cells up for OpenGL, and who draws them.
///
/// `stream`: the processor culls, sorts and sets up each frame's cells and sends some 130 bytes for each. `resident`:
/// the mesh stays on the GPU, compute shaders do all of that there, and a frame sends the camera (and 4 bytes a cell
/// where the order has no keys). Both are drawn by the rasterizer with blending. `tiles`: like resident, and compute
/// shaders draw as well, each tile of the image front to back (gl_tiles.h). `measured`: resident or tiles, whichever
/// the first frames show to be the faster (gl_draw_trial.h).
///
/// The rule of `auto`: measured where there is a GPU; without tiles where its driver refuses their shaders; stream
/// where it refuses those of `resident` too (they need OpenGL 4.3 and doubles) or buffers of the mesh's size, and on
/// software renderers, where all paths compute on the same processor and stream does so with SIMD, without writing what
/// it is going to read at once. What is not measured follows from what crosses the bus and from measurements on
/// llvmpipe; no GPU has been measured.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace tetralux::projection {

enum class GlPath { Auto, Stream, Resident, Tiles, Measured };

/// "auto", "stream", "resident", "tiles", "measured".
std::vector<std::string> glPathNames();

/// \throws std::runtime_error listing the names.
GlPath parseGlPath(std::string_view name);

/// Whether GL_RENDERER names one of Mesa's software renderers.
bool isSoftwareRenderer(std::string_view renderer);

/// A path other than Auto, and why it was taken: one line.
struct GlPathChoice {
    GlPath path;
    std::string reason;
};

/// The rule. `keepCells` and `makeTiles` make what the paths need and throw std::runtime_error where the driver
/// refuses: that is the reason then. \throws what they throw when the path that needs it was asked for.
GlPathChoice chooseGlPath(GlPath wanted, std::string_view renderer, const std::function<void()>& keepCells,
                          const std::function<void()>& makeTiles);

}  // namespace tetralux::projection
