// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <mesh/tet/field.h>
#include <mesh/tet/mesh_statistics.h>

namespace tetralux::apps {

/// A histogram with axes.
struct HistogramPlot {
    std::string title, fieldName;
    mesh::Association association = mesh::Association::Point;  ///< what is counted
    mesh::Histogram histogram;
    bool logarithmic = false;  ///< counts
};

/// To a file that ends in ".svg" or ".png", which appears whole or not at all. \throws std::runtime_error
void writeHistogram(const HistogramPlot& plot, const std::string& path);

/// The text of the SVG.
std::string histogramAsSvg(const HistogramPlot& plot);

}  // namespace tetralux::apps
