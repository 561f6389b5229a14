// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <projection/gl/gl_functions.h>

namespace tetralux::projection {

/// Whether the renderer's samplers interpolate float textures with weights of float precision: measured by sampling
/// between two texels, 0 and 1, at 256 places that no 8-bit weight can name. Software renderers do, many GPUs have 8
/// fractional bits.
bool linearSamplerIsExact(const GlFunctions& gl);

}  // namespace tetralux::projection
