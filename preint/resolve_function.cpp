// SPDX-License-Identifier: Apache-2.0
//
// A transfer function in absolute units: opacity becomes extinction, fractions become scalars.
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include <fmt/format.h>

#include <preint/categorical_colors.h>
#include <preint/log_scale.h>
#include <preint/opacity_words.h>
#include <preint/transfer_function.h>

namespace tetralux::preint {
namespace {

constexpr double largest = 1e300;  // finite, however large the fractions and small the extent

/// Opacity and what is per extent, as extinction per unit.
void makeExtinction(TransferFunction& function, const FitTo& to) {
    constexpr double unitDistancesPerDiagonal = 50.0, opaquePerDiagonal = 1e4;
    if (!function.opacity.empty()) {
        const double diagonal = to.diagonal > 0.0 ? to.diagonal : to.extent > 0.0 ? to.extent : 1.0;
        const double distance = function.unitDistance.value_or(diagonal / unitDistancesPerDiagonal);
        function.extinction = opticalDepths(function.opacity, opaquePerDiagonal * distance / diagonal);
        for (ExtinctionNode& node : function.extinction)
            node.extinction = std::min(node.extinction / distance, largest);
    } else if (function.extinctionPerExtent && to.extent > 0.0) {
        for (ExtinctionNode& node : function.extinction)
            node.extinction = std::min(node.extinction / to.extent, largest);
    }
    for (ExtinctionNode& node : function.extinction)
        node.extinction = std::min(node.extinction * function.opacityScale, largest);
    for (Isosurface& surface : function.isosurfaces)
        surface.opacity = std::min(1.0, surface.opacity * function.opacityScale);
    function.opacity.clear();
    function.unitDistance.reset();
    function.extinctionPerExtent = function.extinctionSuggested = false;
    function.opacityScale = 1.0;
}

template <class Change>
void changeScalars(TransferFunction& function, const Change& change) {
    for (ColorNode& node : function.color) node.scalar = change(node.scalar);
    for (ExtinctionNode& node : function.extinction) node.scalar = change(node.scalar);
    for (OpacityNode& node : function.opacity) node.scalar = change(node.scalar);
    for (Isosurface& surface : function.isosurfaces) surface.value = change(surface.value);
}

/// The first node's value below `above`, the last one's from there on.
template <class Node>
void makeStep(std::vector<Node>& nodes, double above) {
    if (nodes.empty()) return;
    nodes = {nodes.front(), nodes.back()};
    for (Node& node : nodes) node.scalar = above;
}

/// All of it at one scalar: a jump holds from above.
void makeStepAt(TransferFunction& function, double scalar) {
    const double above = std::nextafter(scalar, std::numeric_limits<double>::infinity());
    makeStep(function.color, above);
    makeStep(function.extinction, above);
    makeStep(function.opacity, above);
    for (Isosurface& surface : function.isosurfaces) surface.value = above;
}

/// Scalars become fractions of the way from the first node to the last.
void makeFractions(TransferFunction& function) {
    double first = std::numeric_limits<double>::infinity(), last = -first;
    changeScalars(function, [&](double scalar) {
        first = std::min(first, scalar);
        last = std::max(last, scalar);
        return scalar;
    });
    if (!function.categories.empty() && !(last >= first)) return;
    if (!(last > first))
        throw std::runtime_error(
            "transfer function: a window cannot stretch it, all its nodes are at one scalar; give it two or leave the "
            "window out");
    changeScalars(function, [&](double scalar) { return (scalar - first) / (last - first); });
}

/// Fractions become scalars from `low` to `high`, or of that range of the logarithm.
void stretchOver(TransferFunction& function, double low, double high) {
    if (!function.logarithmic) {
        const auto scalarOf = [&](double fraction) {
            return std::clamp(std::lerp(low, high, fraction), -largest, largest);
        };
        changeScalars(function, scalarOf);
        return;
    }
    if (!(low > 0.0))
        throw std::runtime_error(fmt::format(
            "logarithmic scale: it goes from {} to {}, and there is no logarithm but of what is above 0; give "
            "a range above 0, or leave the scale linear",
            low, high));
    const double logLow = std::log(low), logHigh = std::log(high);
    changeScalars(function, [&](double fraction) { return std::lerp(logLow, logHigh, fraction); });
    const auto scalarOf = [&](double logarithm) {  // the ends are not rounded
        if (logarithm == logLow) return low;
        return logarithm == logHigh ? high : std::min(std::exp(logarithm), largest);
    };
    function.color = fromLogarithms(function.color, scalarOf);
    function.extinction = fromLogarithms(function.extinction, scalarOf);
    function.opacity = fromLogarithms(function.opacity, scalarOf);
    for (Isosurface& surface : function.isosurfaces) surface.value = scalarOf(surface.value);
}

}  // namespace

TransferFunction resolved(const TransferFunction& function, const FitTo& to) {
    TransferFunction absolute = function;
    double low = function.range ? function.range->x : to.scalarMin;
    double high = function.range ? function.range->y : to.scalarMax;
    if (function.range && low == high) {
        makeStepAt(absolute, low);
    } else if (function.range || function.normalized) {
        if (!(high > low)) {  // a constant field has no range: it shows as the middle of one
            const double half = 0.5 * (function.logarithmic ? 0.5 * std::abs(low) : std::max(1.0, std::abs(low)));
            low -= half;
            high += half;
        }
        if (!function.normalized) makeFractions(absolute);
        stretchOver(absolute, low, high);
    } else if (function.logarithmic) {
        throw std::runtime_error(
            "logarithmic scale: this transfer function names its own scalars; give a range to stretch it over, or "
            "leave the scale linear");
    }
    if (!function.categories.empty()) absolute.color = categoricalColors(function.categories, to.values, low, high);
    makeExtinction(absolute, to);
    absolute.normalized = absolute.logarithmic = false;
    absolute.range.reset();
    absolute.categories.clear();
    return absolute;
}

TransferFunction resolved(const TransferFunction& function, double scalarMin, double scalarMax, double extent) {
    return resolved(function, {scalarMin, scalarMax, extent, 0.0, {}});
}

TransferFunction windowed(const TransferFunction& function, double low, double high, double extent) {
    TransferFunction stretched = function;
    stretched.range = glm::dvec2(low, high);
    return resolved(stretched, low, high, extent);
}

}  // namespace tetralux::preint
