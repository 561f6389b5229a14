// SPDX-License-Identifier: Apache-2.0
//
// Histograms with axes: one bar for each class that has anything, as high as its count or the logarithm of it.
#include <apps/histogram_plot.h>

#include <cmath>
#include <sstream>
#include <vector>

#include <gtest/gtest.h>

namespace tetralux::apps {
namespace {

struct Bar {
    double left = 0, right = 0, height = 0;  // pixels
};

/// Polygons of four corners in the SVG's order: a bar's feet and top.
std::vector<Bar> barsOf(const std::string& svg) {
    std::vector<Bar> bars;
    const std::string key = "points=\"";
    for (std::size_t at = svg.find("<polygon"); at != std::string::npos; at = svg.find("<polygon", at + 1)) {
        std::string numbers = svg.substr(svg.find(key, at) + key.size());
        for (char& c : numbers) c = c == ',' ? ' ' : c;
        std::istringstream in(numbers);
        double x0, y0, x1, y1, x2, y2;
        in >> x0 >> y0 >> x1 >> y1 >> x2 >> y2;
        bars.push_back({x0, x2, y0 - y1});
    }
    return bars;
}

HistogramPlot plotOf(const std::vector<double>& values, bool logarithmic) {
    return {"s of a mesh", "s", mesh::Association::Point, mesh::histogramOf(values), logarithmic};
}

TEST(Histogram, BarsAreAsHighAsTheirCounts) {
    std::vector<double> values(100, 0.0);
    values.insert(values.end(), 10, 1.0);
    values.push_back(2.0);
    values.push_back(std::nan(""));
    const std::string svg = histogramAsSvg(plotOf(values, false));
    const auto bars = barsOf(svg);
    ASSERT_EQ(bars.size(), 3u);
    EXPECT_NEAR(bars[0].height / bars[1].height, 10.0, 0.1);
    EXPECT_NEAR(bars[0].right - bars[0].left, bars[2].right - bars[2].left, 0.1);
    EXPECT_NEAR((bars[1].left - bars[0].left) / (bars[0].right - bars[0].left), 32.0, 0.7) << "64 classes from 0 to 2";
    for (const char* text :
         {"s of a mesh", "points per class", "111 points in 64 classes", "1 without a value", ">0<", ">2<"})
        EXPECT_NE(svg.find(text), std::string::npos) << text;
}

TEST(Histogram, LogarithmsOfCounts) {
    std::vector<double> values(100, 0.0);
    values.insert(values.end(), 10, 1.0);
    values.push_back(2.0);
    const auto bars = barsOf(histogramAsSvg(plotOf(values, true)));
    ASSERT_EQ(bars.size(), 3u);
    EXPECT_NEAR(bars[0].height - bars[1].height, bars[1].height - bars[2].height, 0.3)
        << "a decade each, to a tenth of a pixel";
    EXPECT_GT(bars[2].height, 5) << "one alone shows";
}

TEST(Histogram, OneValueIsOneBar) {
    const std::string svg = histogramAsSvg(plotOf({3, 3, 3}, false));
    EXPECT_EQ(barsOf(svg).size(), 1u);
    EXPECT_NE(svg.find("one value everywhere"), std::string::npos);
}

}  // namespace
}  // namespace tetralux::apps
