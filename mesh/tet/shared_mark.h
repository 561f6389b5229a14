// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>

namespace tetralux::mesh {

/// Sets a mark that many threads set. It is looked at first, so that they do not take the cache line from each other.
inline void setMark(std::uint8_t& mark) {
    const std::atomic_ref<std::uint8_t> shared(mark);
    if (shared.load(std::memory_order_relaxed) == 0) {
        shared.store(1, std::memory_order_relaxed);
    }
}

}  // namespace tetralux::mesh
