// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <projection/core/scene.h>

namespace tetralux::projection {

/// The same picture with scalars that can be divided by: where the field's range is that of denormal numbers, scalars
/// and transfer function are scaled by a power of two, which rounds nothing. Every other scene is returned as it is.
Scene withScalarsInRange(const Scene& scene);

}  // namespace tetralux::projection
