// SPDX-License-Identifier: Apache-2.0
#include <apps/nice_ticks.h>

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace tetralux::apps {

namespace {

/// Multiples of a step within the limits, a hair's breadth beyond them counted in.
struct Multiples {
    double first, last;
    double count() const { return last - first + 1.0; }
};

Multiples multiplesOf(double step, double low, double high) {
    constexpr double hair = 1e-9;  // steps
    return {std::ceil(low / step - hair), std::floor(high / step + hair)};
}

}  // namespace

std::vector<Tick> niceTicks(double low, double high, int most) {
    if (!std::isfinite(low) || !std::isfinite(high) || high < low) return {};
    const double width = high - low;
    // what doubles cannot tell apart needs no scale
    if (!(width > 1e-12 * std::max(std::abs(low), std::abs(high))) || !std::isfinite(width))
        return {{low, fmt::format("{:.6g}", low)}};
    double power = std::pow(10.0, std::floor(std::log10(width)) - 2.0), step = power;
    for (int k = 0; multiplesOf(step, low, high).count() > most; ++k) {
        constexpr double factors[] = {1.0, 2.0, 5.0};
        if (k > 0 && k % 3 == 0) power *= 10.0;
        step = power * factors[k % 3];
    }
    const Multiples multiples = multiplesOf(step, low, high);
    const double largest = std::max(std::abs(low), std::abs(high));
    const auto decade = [](double size) { return static_cast<int>(std::floor(std::log10(size) + 1e-9)); };
    const int digits = std::max(6, 1 + decade(largest) - decade(step));  // trailing zeros are left out
    std::vector<Tick> ticks;
    for (double k = multiples.first; k <= multiples.last; ++k) {
        const double value = k == 0.0 ? 0.0 : k * step;  // not −0
        ticks.push_back({value, fmt::format("{:.{}g}", value, digits)});
    }
    return ticks;
}

std::vector<Tick> decadeTicks(double low, double high, int most) {
    if (!(low > 0.0) || !std::isfinite(high) || high < low) return {};
    constexpr double hair = 1e-9;  // of a value
    const int first = static_cast<int>(std::floor(std::log10(low))),
              last = static_cast<int>(std::ceil(std::log10(high)));
    const auto ticksOf = [&](int stride, const std::vector<double>& factors) {
        std::vector<Tick> ticks;
        for (int decade = first; decade <= last; ++decade) {
            if (decade % stride != 0) continue;
            for (const double factor : factors) {
                const double value = factor * std::pow(10.0, decade);
                if (value >= low * (1.0 - hair) && value <= high * (1.0 + hair))
                    ticks.push_back({value, fmt::format("{:.6g}", value)});
            }
        }
        return ticks;
    };
    for (const std::vector<double>& factors : {std::vector<double>{1.0, 2.0, 5.0}, {1.0, 3.0}}) {
        std::vector<Tick> ticks = ticksOf(1, factors);
        if (ticks.size() >= 2 && static_cast<int>(ticks.size()) <= most) return ticks;
    }
    for (int stride = 1; stride <= std::max(1, last - first); ++stride) {
        std::vector<Tick> ticks = ticksOf(stride, {1.0});
        if (static_cast<int>(ticks.size()) <= most && ticks.size() >= 2) return ticks;
    }
    return niceTicks(low, high, most);
}

}  // namespace tetralux::apps
