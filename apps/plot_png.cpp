// SPDX-License-Identifier: Apache-2.0
#include <apps/plot_canvas.h>

#include <cairo.h>

#include <numbers>
#include <stdexcept>

namespace tetralux::apps {

namespace {

constexpr double pixelsPerUnit = 2.0;  // sharp on dense screens and in print

class PngCanvas final : public PlotCanvas {
public:
    PngCanvas(int width, int height)
        : surface_(cairo_image_surface_create(CAIRO_FORMAT_RGB24, static_cast<int>(width * pixelsPerUnit),
                                              static_cast<int>(height * pixelsPerUnit))),
          cairo_(cairo_create(surface_)) {
        cairo_scale(cairo_, pixelsPerUnit, pixelsPerUnit);
        cairo_set_source_rgb(cairo_, 1, 1, 1);
        cairo_paint(cairo_);
        cairo_select_font_face(cairo_, "DejaVu Sans", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
    }
    ~PngCanvas() override {
        cairo_destroy(cairo_);
        cairo_surface_destroy(surface_);
    }
    PngCanvas(const PngCanvas&) = delete;
    PngCanvas& operator=(const PngCanvas&) = delete;

    void polyline(const std::vector<glm::dvec2>& points, const std::string& color, double width) override {
        path(points);
        setColor(color);
        cairo_set_line_width(cairo_, width);
        cairo_stroke(cairo_);
    }

    void polygon(const std::vector<glm::dvec2>& corners, const std::string& fill, const std::string& edge,
                 const std::string&) override {
        path(corners);
        cairo_close_path(cairo_);
        if (fill != "none") {
            setColor(fill);
            cairo_fill_preserve(cairo_);
        }
        setColor(edge);
        cairo_set_line_width(cairo_, 1.0);
        cairo_stroke(cairo_);
    }

    void text(const glm::dvec2& at, const std::string& text, double size, TextAnchor anchor, bool upwards) override {
        cairo_save(cairo_);
        cairo_set_source_rgb(cairo_, 0, 0, 0);
        cairo_set_font_size(cairo_, size);
        cairo_text_extents_t extents;
        cairo_text_extents(cairo_, text.c_str(), &extents);
        cairo_translate(cairo_, at.x, at.y);
        if (upwards) cairo_rotate(cairo_, -0.5 * std::numbers::pi);
        const double share = anchor == TextAnchor::Start ? 0.0 : anchor == TextAnchor::Middle ? 0.5 : 1.0;
        cairo_move_to(cairo_, -share * extents.x_advance, 0.0);
        cairo_show_text(cairo_, text.c_str());
        cairo_restore(cairo_);
    }

    std::string bytes() override {
        std::string png;
        const auto append = [](void* closure, const unsigned char* data, unsigned int length) {
            static_cast<std::string*>(closure)->append(reinterpret_cast<const char*>(data), length);
            return CAIRO_STATUS_SUCCESS;
        };
        const cairo_status_t status = cairo_surface_write_to_png_stream(surface_, append, &png);
        if (status != CAIRO_STATUS_SUCCESS)
            throw std::runtime_error(std::string("plot: cairo made no PNG (") + cairo_status_to_string(status) +
                                     "); write an SVG instead");
        return png;
    }

private:
    void path(const std::vector<glm::dvec2>& points) {
        cairo_new_path(cairo_);
        for (const glm::dvec2& p : points) cairo_line_to(cairo_, p.x, p.y);
    }

    void setColor(const std::string& hex) {
        const auto channel = [&](std::size_t at) { return std::stoi(hex.substr(at, 2), nullptr, 16) / 255.0; };
        cairo_set_source_rgb(cairo_, channel(1), channel(3), channel(5));
    }

    cairo_surface_t* surface_;
    cairo_t* cairo_;
};

}  // namespace

std::unique_ptr<PlotCanvas> makePngCanvas(int width, int height) {
    return std::make_unique<PngCanvas>(width, height);
}

}  // namespace tetralux::apps
