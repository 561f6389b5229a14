// SPDX-License-Identifier: Apache-2.0
/// \file
/// Who sets cells up for OpenGL.
///
/// `stream`: the processor culls, sorts and sets up each frame's cells and sends some 130 bytes for each. `resident`:
/// the mesh stays on the GPU, compute shaders do all of that there, and a frame sends the camera (and 4 bytes a cell
/// where the order has no keys).
///
/// The rule of `auto`: resident where there is a GPU, unless its driver refuses the shaders (they need OpenGL 4.3 and
/// doubles) or buffers of the mesh's size; stream on software renderers, where both paths compute on the same processor
/// and stream does so with SIMD, without writing what it is going to read at once. It follows from what crosses the bus
/// and from measurements on llvmpipe; no GPU has been measured.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace tetralux::projection {

enum class GlPath { Auto, Stream, Resident };

/// "auto", "stream", "resident".
std::vector<std::string> glPathNames();

/// \throws std::runtime_error listing the names.
GlPath parseGlPath(std::string_view name);

/// Whether GL_RENDERER names one of Mesa's software renderers.
bool isSoftwareRenderer(std::string_view renderer);

}  // namespace tetralux::projection
