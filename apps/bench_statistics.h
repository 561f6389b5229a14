// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

namespace tetralux::apps {

/// The middle value, or the mean of the two middle ones. \throws std::runtime_error when there is none.
double median(std::vector<double> values);

struct TimeAndError {
    double time, error;
};

/// Indices, by ascending time, of the points that no other point beats: being faster and no worse, or better and no
/// slower. Of equal points the first stands for all. Points with a time or error that is not finite are left out.
std::vector<std::size_t> paretoFront(const std::vector<TimeAndError>& points);

}  // namespace tetralux::apps
