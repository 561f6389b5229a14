// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <projection/core/scene.h>

namespace tetralux::projection {

/// Why the scene's transfer function may not show what was meant, in one clause, or nothing: all its nodes lie on one
/// side of the field's scalars, so that one colour shows; or no way through the mesh gets the opacity of one step of
/// 255.
std::string functionAdvice(const Scene& scene);

}  // namespace tetralux::projection
