// SPDX-License-Identifier: Apache-2.0
/// \file
/// Internal: loops marked `omp simd`, compiled a second time for processors with vectors of 8 floats.
#pragma once

#if defined(__x86_64__) && defined(__GNUC__)
/// Before a function that only calls another: all of what it calls becomes part of it, for AVX2.
#define TETRALUX_WIDE [[gnu::flatten, gnu::target("avx2")]]
namespace tetralux::shading {
inline bool hasWideVectors() {
    static const bool has = __builtin_cpu_supports("avx2");
    return has;
}
}  // namespace tetralux::shading
#else
#define TETRALUX_WIDE
namespace tetralux::shading {
inline bool hasWideVectors() {
    return false;
}
}  // namespace tetralux::shading
#endif
