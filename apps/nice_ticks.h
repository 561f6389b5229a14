// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace tetralux::apps {

/// Where an axis is marked, and what stands there.
struct Tick {
    double value;
    std::string label;  ///< just enough digits to tell neighbours apart
};

/// The multiples of 1, 2 or 5 times a power of ten within [low, high]: at most `most` (≥ 2), and the most that this
/// allows. One tick where low = high; none when a limit is not finite.
std::vector<Tick> niceTicks(double low, double high, int most);

/// The same for an axis of the logarithm, 0 < low: powers of ten, every second, third … where there are many; 2 and 5
/// times them too where there are few. niceTicks where that leaves fewer than two.
std::vector<Tick> decadeTicks(double low, double high, int most);

}  // namespace tetralux::apps
