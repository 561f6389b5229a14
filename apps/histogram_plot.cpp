// SPDX-License-Identifier: Apache-2.0
#include <apps/histogram_plot.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include <apps/nice_ticks.h>
#include <apps/plot.h>
#include <apps/plot_canvas.h>

namespace tetralux::apps {

namespace {

// All in pixels.
constexpr int width = 640, height = 400;
constexpr double left = 78, right = 20, top = 52, bottom = 58;  // around the axes
constexpr double axisText = 12, titleText = 16, noteText = 11;

constexpr const char* gridColor = "#dddddd";
constexpr const char* axisColor = "#444444";
constexpr const char* barColor = "#0072b2";

/// Counts to heights, linear from 0 or by decades from 1/2, so that a single one shows.
class CountAxis {
public:
    CountAxis(std::uint64_t largest, bool logarithmic) : logarithmic_(logarithmic) {
        const auto most = static_cast<double>(std::max<std::uint64_t>(largest, 1));
        if (logarithmic) {
            low_ = std::log10(0.5);
            high_ = std::max(1.0, std::ceil(std::log10(most)));
            for (double power = 0; power <= high_; ++power)
                ticks_.push_back({std::pow(10.0, power), fmt::format("{:.0f}", std::pow(10.0, power))});
        } else {
            high_ = 1.05 * most;
            ticks_ = niceTicks(0.0, high_, 7);
            std::erase_if(ticks_, [](const Tick& tick) { return tick.value != std::round(tick.value); });
        }
    }
    const std::vector<Tick>& ticks() const { return ticks_; }
    /// 0 at the lower, 1 at the upper end.
    double share(double count) const {
        if (logarithmic_) count = count > 0 ? std::log10(count) : low_;
        return (count - low_) / (high_ - low_);
    }

private:
    bool logarithmic_;
    double low_ = 0.0, high_ = 1.0;  // of the logarithm where logarithmic
    std::vector<Tick> ticks_;
};

/// A constant field is one class in the middle of three.
mesh::Histogram withWidth(mesh::Histogram histogram, std::uint64_t values) {
    if (!histogram.counts.empty()) return histogram;
    const double half = 0.5 * std::max(1.0, std::abs(histogram.low));
    histogram.counts = {0, values, 0};
    histogram.high = histogram.low + half;
    histogram.low -= half;
    return histogram;
}

std::string draw(const HistogramPlot& plot, std::unique_ptr<PlotCanvas> (*makeCanvas)(int, int)) {
    const mesh::Histogram& given = plot.histogram;
    const std::uint64_t counted = std::accumulate(given.counts.begin(), given.counts.end(), std::uint64_t{0});
    const mesh::Histogram shown = withWidth(given, 1);
    const CountAxis counts(*std::max_element(shown.counts.begin(), shown.counts.end()), plot.logarithmic);
    const auto pixelX = [&](double share) { return left + share * (width - left - right); };
    const auto pixelY = [&](double count) { return height - bottom - counts.share(count) * (height - top - bottom); };
    const double floor = height - bottom;

    const auto canvas = makeCanvas(width, height);
    canvas->text({left, 22}, plot.title, titleText, TextAnchor::Start, false);
    const char* const what = plot.association == mesh::Association::Point ? "points" : "cells";
    canvas->text(
        {left, 40},
        fmt::format("{:.6g} to {:.6g}, mean {:.6g}{}{}", given.low, given.high, given.mean,
                    given.counts.empty() ? ", one value everywhere"
                                         : fmt::format("; {} {} in {} classes", counted, what, given.counts.size()),
                    given.nonFinite > 0 ? fmt::format("; {} without a value", given.nonFinite) : ""),
        noteText, TextAnchor::Start, false);
    for (const Tick& tick : counts.ticks()) {
        const double y = pixelY(tick.value);
        canvas->polyline({{left, y}, {width - right, y}}, gridColor, 1.0);
        canvas->text({left - 6, y + 4}, tick.label, axisText, TextAnchor::End, false);
    }
    const auto classes = static_cast<double>(shown.counts.size());
    for (std::size_t i = 0; i < shown.counts.size(); ++i) {
        if (shown.counts[i] == 0) continue;
        const double x0 = pixelX(static_cast<double>(i) / classes), x1 = pixelX(static_cast<double>(i + 1) / classes),
                     y = pixelY(static_cast<double>(shown.counts[i]));
        canvas->polygon({{x0, floor}, {x0, y}, {x1, y}, {x1, floor}}, barColor, "#ffffff",
                        fmt::format("{}", shown.counts[i]));
    }
    for (const Tick& tick : niceTicks(shown.low, shown.high, 8)) {
        const double x = pixelX(tick.value / (shown.high - shown.low) - shown.low / (shown.high - shown.low));
        canvas->polyline({{x, floor}, {x, floor + 5}}, axisColor, 1.0);
        canvas->text({x, floor + 19}, tick.label, axisText, TextAnchor::Middle, false);
    }
    canvas->polyline({{left, top}, {left, floor}, {width - right, floor}}, axisColor, 1.0);
    canvas->text({0.5 * (left + width - right), floor + 42}, plot.fieldName, axisText, TextAnchor::Middle, false);
    canvas->text({18, 0.5 * (top + floor)}, fmt::format("{} per class", what), axisText, TextAnchor::Middle, true);
    return canvas->bytes();
}

}  // namespace

std::string histogramAsSvg(const HistogramPlot& plot) {
    return draw(plot, makeSvgCanvas);
}

void writeHistogram(const HistogramPlot& plot, const std::string& path) {
    writePlotFile(path, [&](auto makeCanvas) { return draw(plot, makeCanvas); });
}

}  // namespace tetralux::apps
