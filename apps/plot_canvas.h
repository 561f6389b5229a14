// SPDX-License-Identifier: Apache-2.0
/// \file
/// What a plot is drawn with, so that SVG and PNG show the same.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <glm/vec2.hpp>

namespace tetralux::apps {

enum class TextAnchor { Start, Middle, End };

/// Pixels, y downwards; colours as "#rrggbb".
class PlotCanvas {
public:
    virtual ~PlotCanvas() = default;
    virtual void polyline(const std::vector<glm::dvec2>& points, const std::string& color, double width) = 0;
    /// A filled polygon; `note` is what a viewer may show beside the pointer.
    virtual void polygon(const std::vector<glm::dvec2>& corners, const std::string& fill, const std::string& edge,
                         const std::string& note) = 0;
    /// `at` is on the base line; `size` in pixels; `upwards` turns the text by a quarter.
    virtual void text(const glm::dvec2& at, const std::string& text, double size, TextAnchor anchor, bool upwards) = 0;
    /// The finished file.
    virtual std::string bytes() = 0;
};

std::unique_ptr<PlotCanvas> makeSvgCanvas(int width, int height);
std::unique_ptr<PlotCanvas> makePngCanvas(int width, int height);

}  // namespace tetralux::apps
