// SPDX-License-Identifier: Apache-2.0
/// \file
/// The shading texts in double precision; see cell_shading.glsl for the formulas.
#pragma once

#include <preint/glsl_prelude.h>

namespace tetralux::glsl {

#include <shading/cell_shading.glsl>

}  // namespace tetralux::glsl
