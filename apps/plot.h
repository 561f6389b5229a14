// SPDX-License-Identifier: Apache-2.0
/// \file
/// Scatter plots of error against time on logarithmic axes, one panel beside the other, as SVG or PNG.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <apps/plot_canvas.h>

namespace tetralux::apps {

struct PlotPoint {
    double x = 0.0, y = 0.0;  ///< y = 0 (no error at all) is drawn on the lower edge
    int series = 0;
    bool onFront = false;
    std::string note;  ///< SVG shows it when the pointer rests on the point
};

struct PlotPanel {
    std::string title;
    std::vector<PlotPoint> points;
};

struct Plot {
    std::string title, xLabel, yLabel;
    std::vector<std::string> series;
    std::vector<PlotPanel> panels;  ///< row by row
    int columns = 1;
};

/// \throws std::runtime_error when `path` ends neither in ".svg" nor in ".png".
void checkPlotPath(const std::string& path);

/// The file appears whole or not at all. \throws std::runtime_error
void writePlot(const Plot& plot, const std::string& path);

/// Writes what `draw` makes on a canvas of the kind that `path` asks for. The file appears whole or not at all.
void writePlotFile(const std::string& path,
                   const std::function<std::string(std::unique_ptr<PlotCanvas> (*)(int, int))>& draw);

/// The text of the SVG.
std::string plotAsSvg(const Plot& plot);

/// Whole powers of ten that enclose all positive values, a decade at least: the exponents.
struct Decades {
    int low = 0, high = 1;
};
Decades enclosingDecades(const std::vector<double>& values);

}  // namespace tetralux::apps
