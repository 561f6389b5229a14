// SPDX-License-Identifier: Apache-2.0
#include <preint/categorical_colors.h>

#include <cmath>
#include <numeric>

namespace tetralux::preint {

std::vector<ColorNode> categoricalColors(const std::vector<glm::dvec3>& categories, const std::vector<double>& values,
                                         double low, double high) {
    std::vector<double> borders;
    for (std::size_t i = 1; i < values.size(); ++i) borders.push_back(std::midpoint(values[i - 1], values[i]));
    if (values.empty())
        for (std::size_t i = 1; i < categories.size(); ++i)
            borders.push_back(std::lerp(low, high, static_cast<double>(i) / static_cast<double>(categories.size())));
    std::vector<ColorNode> nodes;
    for (std::size_t i = 0; i <= borders.size(); ++i) {
        const glm::dvec3& color = categories[i % categories.size()];
        if (i > 0) nodes.push_back({borders[i - 1], color});
        nodes.push_back({i < borders.size() ? borders[i] : high, color});
    }
    return nodes;
}

}  // namespace tetralux::preint
