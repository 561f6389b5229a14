// SPDX-License-Identifier: Apache-2.0
/// \file
/// Lines, areas and text drawn by cairo, to be put over or under a picture.
#pragma once

#include <memory>
#include <string>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <projection/image/image.h>

namespace tetralux::apps {

/// Transparent at first. Coordinates in pixels, y downwards, pixel centres at halves; colours are display RGB.
class Overlay {
public:
    /// `ink` is the colour of text and lines; text has a rim of the opposite one, to stand out from anything.
    Overlay(int width, int height, const glm::dvec3& ink);
    ~Overlay();
    Overlay(const Overlay&) = delete;
    Overlay& operator=(const Overlay&) = delete;

    void line(const glm::dvec2& from, const glm::dvec2& to, double width, double opacity = 1.0);
    void fill(const glm::dvec2& corner, const glm::dvec2& size, const glm::dvec3& color);
    void frame(const glm::dvec2& corner, const glm::dvec2& size, double width);
    /// `anchor` is the part of the text's box that comes to lie at `at`: 0 left or top, ½ middle, 1 right or bottom.
    /// \throws std::runtime_error when the text is not UTF-8.
    void text(const glm::dvec2& at, const std::string& text, double size, const glm::dvec2& anchor);
    double textWidth(const std::string& text, double size) const;

    void putOver(projection::Image& image) const;
    /// Shows as far as the picture is clear.
    void putUnder(projection::Image& image) const;

private:
    struct Cairo;
    std::unique_ptr<Cairo> cairo_;
    int width_, height_;
    glm::dvec3 ink_;
};

}  // namespace tetralux::apps
