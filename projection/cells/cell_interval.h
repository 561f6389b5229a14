// SPDX-License-Identifier: Apache-2.0
/// \file
/// The interval text in double precision; see cell_interval.glsl for the formulas.
#pragma once

#include <preint/glsl_prelude.h>

namespace tetralux::glsl {

using cell_real = double;
#include <projection/cells/cell_interval.glsl>

}  // namespace tetralux::glsl
