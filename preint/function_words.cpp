// SPDX-License-Identifier: Apache-2.0
#include <preint/function_words.h>

#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include <preint/opacity_words.h>

namespace tetralux::preint {
namespace {

void require(const char* what, double value) {
    if (!(value > 0.0) || !std::isfinite(value))
        throw std::runtime_error(fmt::format("{}: {} will not do; give a number above 0", what, value));
}

/// In place of the function's own, over the scalars that its colours cover.
void setOpacity(TransferFunction& function, std::vector<OpacityNode> nodes) {
    if (!function.normalized && !function.color.empty()) {
        const double low = function.color.front().scalar, high = function.color.back().scalar;
        for (OpacityNode& node : nodes) node.scalar = std::lerp(low, high, node.scalar);
    }
    function.opacity = std::move(nodes);
    function.extinction.clear();
    function.extinctionPerExtent = function.extinctionSuggested = false;
}

}  // namespace

TransferFunction withWords(TransferFunction function, const FunctionWords& words) {
    if (!words.opacity.empty() && !words.opacities.empty())
        throw std::runtime_error("opacity: given as a word and as a list; give one of them");
    if (!words.opacity.empty()) setOpacity(function, opacityOfWord(words.opacity));
    if (!words.opacities.empty()) setOpacity(function, opacityOfValues(words.opacities));
    if (words.unitDistance) {
        require("opacity unit distance", *words.unitDistance);
        if (function.opacity.empty())
            throw std::runtime_error(
                "opacity unit distance: this function has extinction, which is per unit of length; give an opacity "
                "such as "
                "linear, or leave the distance out");
        function.unitDistance = words.unitDistance;
    }
    require("opacity", words.opacityScale);
    function.opacityScale *= words.opacityScale;
    if (words.range) {
        if (!std::isfinite(words.range->x) || !std::isfinite(words.range->y) || !(words.range->x <= words.range->y))
            throw std::runtime_error(
                fmt::format("range: {} to {} is none; give two finite numbers, the lower one first", words.range->x,
                            words.range->y));
        function.range = words.range;
    }
    function.logarithmic = function.logarithmic || words.logScale;
    return function;
}

}  // namespace tetralux::preint
