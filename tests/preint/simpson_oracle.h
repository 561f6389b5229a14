// SPDX-License-Identifier: Apache-2.0
/// \file
/// A segment by its definition, in long double, by adaptive Simpson quadrature: shares nothing with the library but the
/// nodes.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include <preint/exact_integral.h>

namespace tetralux::preint::oracle {

template <class Function>
long double simpsonStep(const Function& f, long double a, long double b, long double fa, long double fm, long double fb,
                        long double whole, long double tolerance, int depth) {
    const long double m = (a + b) / 2, left = f((a + m) / 2), right = f((m + b) / 2);
    const long double low = (m - a) / 6 * (fa + 4 * left + fm), high = (b - m) / 6 * (fm + 4 * right + fb);
    const long double change = low + high - whole;
    if (depth <= 0 || std::abs(change) <= 15 * tolerance) return low + high + change / 15;
    return simpsonStep(f, a, m, fa, left, fm, low, tolerance / 2, depth - 1) +
           simpsonStep(f, m, b, fm, right, fb, high, tolerance / 2, depth - 1);
}

/// To a relative 1e-14 of a first estimate by 64 panels, so that narrow integrands are seen at all.
template <class Function>
long double simpson(const Function& f, long double a, long double b) {
    constexpr int panels = 64;
    long double estimate = 0, sum = 0;
    for (int i = 0; i < panels; ++i) estimate += std::abs(f(a + (b - a) * (i + 0.5L) / panels)) * (b - a) / panels;
    for (int i = 0; i < panels; ++i) {
        const long double low = a + (b - a) * i / panels, high = a + (b - a) * (i + 1) / panels;
        const long double fl = f(low), fm = f((low + high) / 2), fh = f(high);
        sum += simpsonStep(f, low, high, fl, fm, fh, (high - low) / 6 * (fl + 4 * fm + fh), 1e-14L * estimate / panels,
                           40);
    }
    return sum;
}

template <class Node>
std::vector<double> scalarsOf(const std::vector<Node>& nodes) {
    std::vector<double> scalars;
    for (const Node& node : nodes) scalars.push_back(node.scalar);
    return scalars;
}

/// The segment's integrals as design of the image defines them, split at nodes; no isosurfaces.
inline SegmentResult segment(const TransferFunction& function, double front, double back, double length,
                             Integral integral) {
    std::vector<double> cuts = scalarsOf(function.color);
    for (const double s : scalarsOf(function.extinction)) cuts.push_back(s);
    cuts.push_back(front);
    cuts.push_back(back);
    std::sort(cuts.begin(), cuts.end());
    std::erase_if(cuts, [&](double s) { return s < std::min(front, back) || s > std::max(front, back); });
    cuts.erase(std::unique(cuts.begin(), cuts.end()), cuts.end());
    if (back < front) std::reverse(cuts.begin(), cuts.end());

    const long double total = std::abs(static_cast<long double>(back) - front);
    const long double path = integral == Integral::Standard ? static_cast<long double>(length) / total : 1.0L;
    long double depth = 0, color[3] = {0, 0, 0};
    for (std::size_t i = 1; i < cuts.size(); ++i) {
        const long double from = cuts[i - 1], to = cuts[i], step = std::abs(to - from) * path;
        // Linear between the cuts: extrapolate from two inner points, so that jumps at the ends do not matter.
        auto extinctionAt = [&](long double t) {
            const long double p = function.extinctionAt(static_cast<double>(from + (to - from) * 0.25L));
            const long double q = function.extinctionAt(static_cast<double>(from + (to - from) * 0.75L));
            return p + (q - p) * (t - 0.25L) * 2;
        };
        auto colorAt = [&](int channel, long double t) {
            const long double p = function.colorAt(static_cast<double>(from + (to - from) * 0.25L))[channel];
            const long double q = function.colorAt(static_cast<double>(from + (to - from) * 0.75L))[channel];
            return p + (q - p) * (t - 0.25L) * 2;
        };
        const long double a = extinctionAt(0) * step, b = extinctionAt(1) * step;
        for (int channel = 0; channel < 3; ++channel) {
            const long double c0 = colorAt(channel, 0), c1 = colorAt(channel, 1);
            color[channel] += std::exp(-depth) * simpson(
                                                     [&](long double t) {
                                                         return (c0 + (c1 - c0) * t) * (a + (b - a) * t) *
                                                                std::exp(-(a * t + (b - a) * t * t / 2));
                                                     },
                                                     0.0L, 1.0L);
        }
        depth += (a + b) / 2;
    }
    return {{static_cast<double>(color[0]), static_cast<double>(color[1]), static_cast<double>(color[2])},
            static_cast<double>(depth)};
}

}  // namespace tetralux::preint::oracle
