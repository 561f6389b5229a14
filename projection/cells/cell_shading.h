// SPDX-License-Identifier: Apache-2.0
/// \file
/// The shading texts (shading/cell_shading.glsl, shading/light_model.glsl and others) in double precision. Here rather
/// than in shading/ because the prelude is preint's, which shading does not know.
#pragma once

#include <preint/glsl_prelude.h>

namespace tetralux::glsl {

#include <shading/cell_shading.glsl>
#include <shading/light_model.glsl>
#include <shading/silhouette.glsl>
#include <shading/surface_shadow.glsl>

}  // namespace tetralux::glsl
