// SPDX-License-Identifier: Apache-2.0
#include <apps/overlay.h>

#include <cairo.h>

#include <cstdint>
#include <cstring>
#include <stdexcept>

#include <fmt/format.h>
#include <glm/vec4.hpp>

namespace tetralux::apps {

struct Overlay::Cairo {
    cairo_surface_t* surface;
    cairo_t* context;

    Cairo(int width, int height)
        : surface(cairo_image_surface_create(CAIRO_FORMAT_ARGB32, width, height)), context(cairo_create(surface)) {
        cairo_select_font_face(context, "DejaVu Sans", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
        cairo_set_line_cap(context, CAIRO_LINE_CAP_ROUND);
        cairo_set_line_join(context, CAIRO_LINE_JOIN_ROUND);
    }
    ~Cairo() {
        cairo_destroy(context);
        cairo_surface_destroy(surface);
    }
    Cairo(const Cairo&) = delete;
    Cairo& operator=(const Cairo&) = delete;

    void color(const glm::dvec3& c, double opacity) { cairo_set_source_rgba(context, c.r, c.g, c.b, opacity); }

    /// The pixel, linear and premultiplied as an image's.
    glm::vec4 pixel(int x, int y) const {
        std::uint32_t argb = 0;
        std::memcpy(&argb, cairo_image_surface_get_data(surface) + y * cairo_image_surface_get_stride(surface) + 4 * x,
                    4);
        const auto channel = [&](int shift) { return static_cast<float>(argb >> shift & 0xffu) / 255.0f; };
        return {channel(16), channel(8), channel(0), channel(24)};
    }
};

Overlay::Overlay(int width, int height, const glm::dvec3& ink)
    : cairo_(std::make_unique<Cairo>(width, height)), width_(width), height_(height), ink_(ink) {}

Overlay::~Overlay() = default;

void Overlay::line(const glm::dvec2& from, const glm::dvec2& to, double width, double opacity) {
    cairo_move_to(cairo_->context, from.x, from.y);
    cairo_line_to(cairo_->context, to.x, to.y);
    cairo_->color(ink_, opacity);
    cairo_set_line_width(cairo_->context, width);
    cairo_stroke(cairo_->context);
}

void Overlay::fill(const glm::dvec2& corner, const glm::dvec2& size, const glm::dvec3& color) {
    cairo_rectangle(cairo_->context, corner.x, corner.y, size.x, size.y);
    cairo_->color(color, 1.0);
    cairo_fill(cairo_->context);
}

void Overlay::frame(const glm::dvec2& corner, const glm::dvec2& size, double width) {
    cairo_rectangle(cairo_->context, corner.x, corner.y, size.x, size.y);
    cairo_->color(ink_, 1.0);
    cairo_set_line_width(cairo_->context, width);
    cairo_stroke(cairo_->context);
}

void Overlay::text(const glm::dvec2& at, const std::string& text, double size, const glm::dvec2& anchor) {
    cairo_t* const context = cairo_->context;
    cairo_set_font_size(context, size);
    cairo_font_extents_t font;
    cairo_font_extents(context, &font);
    const double width = textWidth(text, size);
    cairo_move_to(context, at.x - anchor.x * width, at.y + font.ascent - anchor.y * (font.ascent + font.descent));
    cairo_text_path(context, text.c_str());
    if (cairo_status(context) != CAIRO_STATUS_SUCCESS)
        throw std::runtime_error(fmt::format("text in the picture: cannot be drawn ({}); give plain UTF-8",
                                             cairo_status_to_string(cairo_status(context))));
    cairo_->color(glm::dvec3(1.0) - ink_, 0.7);
    cairo_set_line_width(context, 0.18 * size);
    cairo_stroke_preserve(context);
    cairo_->color(ink_, 1.0);
    cairo_fill(context);
}

double Overlay::textWidth(const std::string& text, double size) const {
    cairo_set_font_size(cairo_->context, size);
    cairo_text_extents_t extents;
    cairo_text_extents(cairo_->context, text.c_str(), &extents);
    return extents.x_advance;
}

void Overlay::putOver(projection::Image& image) const {
    cairo_surface_flush(cairo_->surface);
    for (int y = 0; y < height_; ++y)
        for (int x = 0; x < width_; ++x) {
            const glm::vec4 drawn = cairo_->pixel(x, y);
            if (drawn.a > 0.0f) image.at(x, y) = drawn + (1.0f - drawn.a) * image.at(x, y);
        }
}

void Overlay::putUnder(projection::Image& image) const {
    cairo_surface_flush(cairo_->surface);
    for (int y = 0; y < height_; ++y)
        for (int x = 0; x < width_; ++x) image.at(x, y) += (1.0f - image.at(x, y).a) * cairo_->pixel(x, y);
}

}  // namespace tetralux::apps
