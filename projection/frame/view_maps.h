// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <projection/core/engine.h>

namespace tetralux::projection {

/// `engine` with the pixel maps of the scene's sources made for each frame, and what lies behind the volume put under
/// it. Returns `engine` itself where the scene has no sources.
std::unique_ptr<Engine> withViewMaps(std::unique_ptr<Engine> engine, const Scene& scene);

}  // namespace tetralux::projection
