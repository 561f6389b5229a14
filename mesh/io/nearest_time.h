// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

namespace tetralux::mesh {

/// The one of `times` nearest to `wanted`, the first if nothing is wanted. `times` must not be empty.
inline double nearestTime(const std::vector<double>& times, std::optional<double> wanted) {
    return wanted ? *std::min_element(times.begin(), times.end(),
                                      [&](double a, double b) { return std::abs(a - *wanted) < std::abs(b - *wanted); })
                  : times.front();
}

}  // namespace tetralux::mesh
