// SPDX-License-Identifier: Apache-2.0
#include <apps/plot.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <limits>
#include <numbers>
#include <stdexcept>

#include <fmt/format.h>

#include <apps/plot_canvas.h>
#include <projection/image/whole_file.h>

namespace tetralux::apps {

namespace {

// All in pixels.
constexpr double panelWidth = 330, panelHeight = 230;
constexpr double left = 62, right = 14, top = 28, bottom = 40;  // around the axes of one panel
constexpr double titleHeight = 34, legendLine = 18, margin = 8;
constexpr double axisText = 11, titleText = 16;
constexpr double markSize = 4.5;

constexpr const char* gridColor = "#dddddd";
constexpr const char* axisColor = "#444444";
constexpr const char* frontColor = "#777777";

/// Okabe & Ito 2008: told apart with any colour vision. Shapes differ too.
constexpr std::array<const char*, 8> seriesColors{"#d55e00", "#0072b2", "#009e73", "#cc79a7",
                                                  "#e69f00", "#56b4e9", "#000000", "#8a7a00"};

struct Shape {
    int corners;
    double firstDegrees;  // from the right, clockwise as y points down
};
constexpr std::array shapes{Shape{16, 0.0}, Shape{4, 45.0}, Shape{3, -90.0}, Shape{4, 0.0}, Shape{3, 90.0}};

std::vector<glm::dvec2> mark(int series, const glm::dvec2& at) {
    const Shape& shape = shapes[static_cast<std::size_t>(series) % shapes.size()];
    std::vector<glm::dvec2> points;
    for (int i = 0; i < shape.corners; ++i) {
        const double angle = (shape.firstDegrees + 360.0 * i / shape.corners) * std::numbers::pi / 180.0;
        points.push_back(at + markSize * glm::dvec2(std::cos(angle), std::sin(angle)));
    }
    return points;
}

const char* seriesColor(int series) {
    return seriesColors[static_cast<std::size_t>(series) % seriesColors.size()];
}

/// One panel's axes: decades to pixels.
struct Axes {
    Decades x, y;
    glm::dvec2 low, high;  // pixels of the lower left and upper right corner

    double pixelX(double exponent) const { return low.x + (exponent - x.low) / (x.high - x.low) * (high.x - low.x); }
    double pixelY(double exponent) const { return low.y + (exponent - y.low) / (y.high - y.low) * (high.y - low.y); }
    glm::dvec2 pixel(const PlotPoint& point) const {
        const double exponentX = point.x > 0.0 ? std::log10(point.x) : x.low;
        const double exponentY = point.y > 0.0 ? std::log10(point.y) : y.low;
        return {pixelX(std::clamp<double>(exponentX, x.low, x.high)),
                pixelY(std::clamp<double>(exponentY, y.low, y.high))};
    }
};

std::string powerOfTen(int exponent) {
    if (exponent >= 0 && exponent <= 5) return fmt::format("{:.0f}", std::pow(10.0, exponent));
    return fmt::format("1e{}", exponent);
}

void drawAxes(PlotCanvas& canvas, const Axes& axes, const Plot& plot) {
    for (int e = axes.x.low; e <= axes.x.high; ++e) {
        const double x = axes.pixelX(e);
        canvas.polyline({{x, axes.low.y}, {x, axes.high.y}}, gridColor, 1.0);
        canvas.text({x, axes.low.y + 14}, powerOfTen(e), axisText, TextAnchor::Middle, false);
    }
    const int step = axes.y.high - axes.y.low > 6 ? 2 : 1;
    for (int e = axes.y.low; e <= axes.y.high; e += step) {
        const double y = axes.pixelY(e);
        canvas.polyline({{axes.low.x, y}, {axes.high.x, y}}, gridColor, 1.0);
        canvas.text({axes.low.x - 5, y + 4}, powerOfTen(e), axisText, TextAnchor::End, false);
    }
    canvas.polyline({{axes.low.x, axes.high.y}, axes.low, {axes.high.x, axes.low.y}}, axisColor, 1.0);
    canvas.text({0.5 * (axes.low.x + axes.high.x), axes.low.y + 30}, plot.xLabel, axisText, TextAnchor::Middle, false);
    canvas.text({axes.low.x - 46, 0.5 * (axes.low.y + axes.high.y)}, plot.yLabel, axisText, TextAnchor::Middle, true);
}

/// Stairs through the points that nothing beats: all that lies above and to the right of them is beaten.
void drawFront(PlotCanvas& canvas, const Axes& axes, const PlotPanel& panel) {
    std::vector<glm::dvec2> front;
    for (const PlotPoint& point : panel.points)
        if (point.onFront) front.push_back(axes.pixel(point));
    if (front.empty()) return;
    std::sort(front.begin(), front.end(), [](const auto& a, const auto& b) { return a.x < b.x; });
    std::vector<glm::dvec2> stairs{{front.front().x, axes.high.y}};
    for (const glm::dvec2& point : front) {
        stairs.emplace_back(point.x, stairs.back().y);
        stairs.push_back(point);
    }
    stairs.emplace_back(axes.high.x, stairs.back().y);
    canvas.polyline(stairs, frontColor, 1.5);
}

void drawPanel(PlotCanvas& canvas, const Axes& axes, const Plot& plot, const PlotPanel& panel) {
    canvas.text({axes.low.x, axes.high.y - 8}, panel.title, axisText + 1, TextAnchor::Start, false);
    drawAxes(canvas, axes, plot);
    drawFront(canvas, axes, panel);
    for (const PlotPoint& point : panel.points)
        canvas.polygon(mark(point.series, axes.pixel(point)), seriesColor(point.series), "#ffffff", point.note);
}

struct LegendEntry {
    glm::dvec2 at;
    int series;
};

/// Entries from left to right, in as many lines as it takes.
std::vector<LegendEntry> layOutLegend(const Plot& plot, double width) {
    std::vector<LegendEntry> entries;
    glm::dvec2 at(margin + 10, titleHeight + 10);
    for (std::size_t i = 0; i < plot.series.size(); ++i) {
        const double needed = 26 + 6.8 * static_cast<double>(plot.series[i].size());
        if (at.x + needed > width && !entries.empty()) at = {margin + 10, at.y + legendLine};
        entries.push_back({at, static_cast<int>(i)});
        at.x += needed;
    }
    return entries;
}

std::string draw(const Plot& plot, std::unique_ptr<PlotCanvas> (*makeCanvas)(int, int)) {
    const int columns = std::max(1, std::min(plot.columns, static_cast<int>(plot.panels.size())));
    const int rows = (static_cast<int>(plot.panels.size()) + columns - 1) / columns;
    const double width = std::max(columns, 2) * panelWidth + 2 * margin;
    const std::vector<LegendEntry> legend = layOutLegend(plot, width);
    const double above = (legend.empty() ? titleHeight : legend.back().at.y + legendLine);
    const auto canvas = makeCanvas(static_cast<int>(width), static_cast<int>(above + rows * panelHeight + margin));

    canvas->text({margin, 22}, plot.title, titleText, TextAnchor::Start, false);
    for (const LegendEntry& entry : legend) {
        canvas->polygon(mark(entry.series, entry.at), seriesColor(entry.series), "#ffffff", "");
        canvas->text(entry.at + glm::dvec2(10, 4), plot.series[static_cast<std::size_t>(entry.series)], axisText,
                     TextAnchor::Start, false);
    }
    std::vector<double> xs, ys;
    for (const PlotPanel& panel : plot.panels) {
        for (const PlotPoint& point : panel.points) {
            xs.push_back(point.x);
            ys.push_back(point.y);
        }
    }
    Axes axes{enclosingDecades(xs), enclosingDecades(ys), {}, {}};
    for (std::size_t i = 0; i < plot.panels.size(); ++i) {
        const glm::dvec2 corner(margin + panelWidth * static_cast<double>(static_cast<int>(i) % columns),
                                above + panelHeight * static_cast<double>(static_cast<int>(i) / columns));
        axes.low = corner + glm::dvec2(left, panelHeight - bottom);
        axes.high = corner + glm::dvec2(panelWidth - right, top);
        drawPanel(*canvas, axes, plot, plot.panels[i]);
    }
    return canvas->bytes();
}

std::string endingOf(const std::string& path) {
    return std::filesystem::path(path).extension().string();
}

}  // namespace

Decades enclosingDecades(const std::vector<double>& values) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const double value : values) {
        if (!(value > 0.0) || !std::isfinite(value)) continue;
        low = std::min(low, std::log10(value));
        high = std::max(high, std::log10(value));
    }
    if (low > high) return {};
    Decades decades{static_cast<int>(std::floor(low)), static_cast<int>(std::ceil(high))};
    decades.high = std::max(decades.high, decades.low + 1);
    return decades;
}

void checkPlotPath(const std::string& path) {
    if (const std::string ending = endingOf(path); ending != ".svg" && ending != ".png")
        throw std::runtime_error(
            fmt::format("{}: no plot can be written to a file of that kind; let it end in .svg or .png", path));
    projection::checkWritable(path);
}

std::string plotAsSvg(const Plot& plot) {
    return draw(plot, makeSvgCanvas);
}

void writePlotFile(const std::string& path,
                   const std::function<std::string(std::unique_ptr<PlotCanvas> (*)(int, int))>& draw) {
    checkPlotPath(path);
    projection::writeWholeFile(path, draw(endingOf(path) == ".png" ? makePngCanvas : makeSvgCanvas));
}

void writePlot(const Plot& plot, const std::string& path) {
    writePlotFile(path, [&](auto makeCanvas) { return draw(plot, makeCanvas); });
}

}  // namespace tetralux::apps
