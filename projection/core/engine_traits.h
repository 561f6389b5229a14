// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <projection/core/perturbed_isosurfaces.h>

namespace tetralux::projection {

/// What those who prepare an engine's scene and mend its pictures need to know of it.
struct EngineTraits {
    double perturbation = floatPerturbation;  ///< by how much isosurfaces stand lower for it; 0: it sees to ties itself
    bool drawsTranslucent = false;            ///< draws PixelMaps::translucent by itself
    bool fromTable = false;                   ///< looks segments up in a table of floats
    bool exact = false;                       ///< composes in double, so that no pixel is uncertain
};

}  // namespace tetralux::projection
