// SPDX-License-Identifier: Apache-2.0
#include <apps/bench_statistics.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace tetralux::apps {

double median(std::vector<double> values) {
    if (values.empty()) throw std::runtime_error("median: there is no value; measure at least one");
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    if (values.size() % 2 == 1) return *middle;
    return 0.5 * (*middle + *std::max_element(values.begin(), middle));
}

std::vector<std::size_t> paretoFront(const std::vector<TimeAndError>& points) {
    std::vector<std::size_t> byTime;
    for (std::size_t i = 0; i < points.size(); ++i)
        if (std::isfinite(points[i].time) && std::isfinite(points[i].error)) byTime.push_back(i);
    std::stable_sort(byTime.begin(), byTime.end(), [&](std::size_t a, std::size_t b) {
        return points[a].time < points[b].time ||
               (points[a].time == points[b].time && points[a].error < points[b].error);
    });
    std::vector<std::size_t> front;
    double least = std::numeric_limits<double>::infinity();
    for (const std::size_t i : byTime) {
        if (points[i].error < least) {
            front.push_back(i);
            least = points[i].error;
        }
    }
    return front;
}

}  // namespace tetralux::apps
