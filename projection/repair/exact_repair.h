// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <projection/core/engine.h>

namespace tetralux::projection {

/// `engine` with the pixels that it isUncertain, those of cells beyond float (float_limits.h) and those of outlines
/// that floats or samples may miss (isosurface_outlines.h, isosurface_perturbation.h) composed by the reference ray
/// caster after each frame. Costs nothing while there are none.
std::unique_ptr<Engine> withExactRepair(std::unique_ptr<Engine> engine, const Scene& scene);

}  // namespace tetralux::projection
