// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>

namespace tetralux::apps {

/// {"cpu", "cores", "memory_bytes", "os", "kernel", "compiler", "tetralux", "load": [1, 5, 15 minutes]}: what the
/// figures were taken with. A load above 0 before a run says that others were using the machine.
nlohmann::json machineDescription();

}  // namespace tetralux::apps
