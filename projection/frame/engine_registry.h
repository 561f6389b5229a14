// SPDX-License-Identifier: Apache-2.0
/// \file
/// The engines that there are, by name.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <projection/core/engine.h>

namespace tetralux::projection {

std::vector<std::string> engineNames();

/// \throws std::runtime_error listing the names there are, or saying what the engine lacks on this machine.
std::unique_ptr<Engine> makeEngine(const Scene& scene, const EngineOptions& options);

}  // namespace tetralux::projection
