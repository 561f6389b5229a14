// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <projection/core/engine.h>

namespace tetralux::projection {

/// Cells projected in visibility order as polygons, their segments looked up and blended by OpenGL; README.md of this
/// folder says how and why. `options.context` names the kind of context. \throws std::runtime_error when there is no
/// context, saying what to install.
std::unique_ptr<Engine> makeGlEngine(const Scene& scene, const EngineOptions& options);

}  // namespace tetralux::projection
