// SPDX-License-Identifier: Apache-2.0
/// \file
/// The rule of scalars that are exactly a node's (value_from_above.glsl) in double precision.
#pragma once

#include <preint/glsl_prelude.h>

namespace tetralux::glsl {

#include <preint/value_from_above.glsl>

}  // namespace tetralux::glsl
