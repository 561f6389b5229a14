// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <projection/core/engine.h>

namespace tetralux::projection {

/// The reference ray caster as an engine: slow and always right.
std::unique_ptr<Engine> makeReferenceEngine(const Scene& scene, const EngineOptions& options);

}  // namespace tetralux::projection
