// SPDX-License-Identifier: Apache-2.0
/// \file
/// Before any Highway header: the instruction sets that the tile engine leaves out. Vectors of a size that only the
/// machine knows cannot stand in classes (cpu_simd.h); such machines run the NEON or the scalar form. SSSE3 would be
/// one more copy of everything for processors of 2006.
#pragma once

#include <hwy/detect_compiler_arch.h>

#define HWY_DISABLED_TARGETS (HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV | HWY_SSSE3)
