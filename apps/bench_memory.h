// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace tetralux::apps {

/// Resident memory of this process now, in bytes; freed memory is given back to the system first.
std::uint64_t trimmedMemoryBytes();

/// Starts a new measurement of the largest resident memory. False where the system has none (then peakMemoryBytes is
/// that of the whole run).
bool restartPeakMemory();

/// Largest resident memory since restartPeakMemory, in bytes.
std::uint64_t peakMemoryBytes();

}  // namespace tetralux::apps
