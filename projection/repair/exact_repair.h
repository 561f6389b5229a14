// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include <projection/core/engine.h>
#include <projection/core/engine_traits.h>

namespace tetralux::projection {

/// `engine` with the pixels of which it is uncertain, those of cells beyond float (float_limits.h) and those of
/// outlines that floats or samples may miss (isosurface_outlines.h, isosurface_perturbation.h) composed by the
/// reference ray caster after each frame. Costs nothing while there are none.
std::unique_ptr<Engine> withExactRepair(std::unique_ptr<Engine> engine, const Scene& scene,
                                        const EngineTraits& traits = {});

}  // namespace tetralux::projection
