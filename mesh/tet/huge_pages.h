// SPDX-License-Identifier: Apache-2.0
/// \file
/// Large arrays in pages of 2 MiB where the system has them to give: the first touch of a page costs more than filling
/// it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <sys/mman.h>
#include <tbb/parallel_for.h>

namespace tetralux::mesh {

/// A hint for memory that has not been touched yet.
inline void preferHugePages(void* begin, std::size_t bytes) {
    constexpr std::uintptr_t page = 4096;
    const std::uintptr_t start = (reinterpret_cast<std::uintptr_t>(begin) + page - 1) / page * page;
    const std::uintptr_t end = (reinterpret_cast<std::uintptr_t>(begin) + bytes) / page * page;
    constexpr std::uintptr_t worthIt = std::uintptr_t{8} << 20;
    if (end > start && end - start >= worthIt) {
        ::madvise(reinterpret_cast<void*>(start), end - start, MADV_HUGEPAGE);
    }
}

/// Has the system clear memory that has not been touched yet, by many threads (Linux 5.14; others do it on touch).
inline void touchPages(void* begin, std::size_t bytes) {
#ifdef MADV_POPULATE_WRITE
    constexpr std::uintptr_t page = std::uintptr_t{2} << 20;
    const std::uintptr_t start = (reinterpret_cast<std::uintptr_t>(begin) + page - 1) / page;
    const std::uintptr_t end = (reinterpret_cast<std::uintptr_t>(begin) + bytes) / page;
    if (end > start) {
        tbb::parallel_for(start, end, [](std::uintptr_t i) {
            ::madvise(reinterpret_cast<void*>(i * page), page, MADV_POPULATE_WRITE);
        });
    }
#endif
}

/// `values.resize(count)` for an empty vector.
template <class Value>
void resizeInHugePages(std::vector<Value>& values, std::size_t count) {
    values.reserve(count);
    preferHugePages(values.data(), count * sizeof(Value));
    touchPages(values.data(), count * sizeof(Value));
    values.resize(count);
}

}  // namespace tetralux::mesh
