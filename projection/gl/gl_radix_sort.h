// SPDX-License-Identifier: Apache-2.0
/// \file
/// Internal: sorting on the GPU.
#pragma once

#include <optional>

#include <glm/vec4.hpp>

#include <projection/gl/gl_compute.h>

namespace tetralux::projection {

/// Sorts the plan's drawn cells by their 32-bit keys, stable, in eight passes of four bits (count, prefix sums,
/// scatter; Satish, Harris & Garland, "Designing Efficient Sorting Algorithms for Manycore GPUs", 2009, with counters
/// per lane instead of their one-bit splits), and settles runs of equal keys by the doubles that they stand for: the
/// order is KeySorter's.
class GlRadixSort {
public:
    GlRadixSort(const GlFunctions& gl, std::size_t cells);

    /// `plan`, bound as the source of indirect commands, has its dispatches at these bytes. `keyed` and `scratch` hold
    /// pairs of key and cell; the result is in `keyed`.
    void sort(GLuint plan, std::size_t sortGroups, std::size_t settleGroups, GLuint keyed, GLuint scratch,
              GLuint keyPlanes, const glm::dvec4& eye) const;

    /// The same for any pairs, by the lower `bits` bits of their first number, in as many passes as these ask for, an
    /// even number. Equal ones stay in their order.
    void sortBits(GLuint plan, std::size_t sortGroups, GLuint keyed, GLuint scratch, unsigned bits) const;

    /// Makes room for so many pairs.
    void reserve(std::size_t cells);

    /// Prefix sums of `count` numbers, followed by the sum of all.
    void scan(GLuint plan, GLuint values, std::size_t count) const;

private:
    const GlFunctions& gl_;
    GlKernel count_, scan_, scatter_, settle_;
    std::optional<GlStorage> digits_;
};

}  // namespace tetralux::projection
