// SPDX-License-Identifier: Apache-2.0
#include <apps/annotation.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <apps/axes_box.h>
#include <apps/nice_ticks.h>
#include <apps/overlay.h>
#include <projection/image/ink.h>

namespace tetralux::apps {

namespace {

/// Sizes follow the picture's smaller side; pixels.
struct Sizes {
    double text, thinLine, gap;

    explicit Sizes(const projection::Camera& camera)
        : text(std::max(9.0, 0.028 * std::min(camera.width, camera.height))),
          thinLine(std::max(1.0, 0.002 * std::min(camera.width, camera.height))),
          gap(0.5 * text) {}
};

Overlay overlayFor(const AnnotatedScene& scene, const projection::Camera& camera) {
    return Overlay(camera.width, camera.height, projection::inkUpon(scene.background));
}

constexpr double boxOpacity = 0.8;

/// Lines no wider than `most` at that size, broken at spaces.
std::vector<std::string> wrapped(const std::string& text, double size, double most, const Overlay& overlay) {
    std::vector<std::string> lines;
    std::string line;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t space = std::min(text.find(' ', at), text.size());
        const std::string word = text.substr(at, space - at), longer = line.empty() ? word : line + " " + word;
        if (!line.empty() && overlay.textWidth(longer, size) > most) {
            lines.push_back(line);
            line = word;
        } else {
            line = longer;
        }
        at = space + 1;
    }
    lines.push_back(line);
    return lines;
}

/// Text in a box of that width: smaller where it is too long, down to 0.65 of the size, then in several lines. Draws it
/// where `draw` is set, its first line's anchor at `at`. \returns the height that it takes.
double drawFitting(const std::string& text, const glm::dvec2& at, double size, double most, double anchor, bool draw,
                   Overlay& overlay) {
    constexpr double least = 0.65, lineHeight = 1.25;
    const double width = overlay.textWidth(text, size);
    const double fitting = width > most ? std::max(least, most / width) * size : size;
    double down = 0.0;
    for (const std::string& line : wrapped(text, fitting, most * (1.0 + 1e-9), overlay)) {
        if (draw) overlay.text(at + glm::dvec2(0, down), line, fitting, {anchor, 0.0});
        down += lineHeight * fitting;
    }
    return down;
}

double titleHeight(const std::string& title, const projection::Camera& camera, const Sizes& sizes, bool draw,
                   Overlay& overlay) {
    return drawFitting(title, {0.5 * camera.width, sizes.gap}, 1.4 * sizes.text, 0.96 * camera.width, 0.5, draw,
                       overlay);
}

void drawAxes(const AxesBox& box, const Sizes& sizes, Overlay& overlay) {
    for (const BoxLine& line : box.lines)
        if (!line.behind) overlay.line(line.from, line.to, sizes.thinLine, boxOpacity);
    for (const BoxLabel& label : box.labels) {
        const glm::dvec2 anchor = 0.5 - 0.5 * label.outward;
        if (label.axisName) {
            overlay.text(label.at + 3.2 * sizes.text * label.outward, label.text, 1.2 * sizes.text, anchor);
        } else {
            const glm::dvec2 end = label.at + sizes.gap * label.outward;
            overlay.line(label.at, end, sizes.thinLine);
            overlay.text(end + 0.3 * sizes.text * label.outward, label.text, sizes.text, anchor);
        }
    }
}

/// Where scalars stand on a bar from 0 to 1: in proportion, by their logarithms, or step by step.
class BarScale {
public:
    explicit BarScale(const AnnotatedScene& scene) : scene_(scene) {}

    double fractionOf(double scalar) const {
        if (steps() > 0) {
            const auto at = std::lower_bound(scene_.values.begin(), scene_.values.end(), scalar);
            return (static_cast<double>(at - scene_.values.begin()) + 0.5) / steps();
        }
        if (!(scene_.high > scene_.low)) return 0.5;
        if (scene_.logarithmic) return std::log(scalar / scene_.low) / std::log(scene_.high / scene_.low);
        return (scalar - scene_.low) / (scene_.high - scene_.low);
    }
    double scalarAt(double fraction) const {
        if (steps() > 0)
            return scene_.values[static_cast<std::size_t>(std::clamp(fraction * steps(), 0.0, steps() - 1.0))];
        if (scene_.logarithmic) return scene_.low * std::pow(scene_.high / scene_.low, fraction);
        return std::lerp(scene_.low, scene_.high, fraction);
    }
    std::vector<Tick> ticks(int most) const {
        if (steps() == 0)
            return scene_.logarithmic ? decadeTicks(scene_.low, scene_.high, most)
                                      : niceTicks(scene_.low, scene_.high, most);
        std::vector<Tick> all;
        const std::size_t stride =
            (scene_.values.size() + static_cast<std::size_t>(most) - 1) / static_cast<std::size_t>(most);
        for (std::size_t i = 0; i < scene_.values.size(); i += stride)
            all.push_back({scene_.values[i], fmt::format("{:.6g}", scene_.values[i])});
        return all;
    }

private:
    double steps() const { return static_cast<double>(scene_.values.size()); }

    const AnnotatedScene& scene_;
};

int barHeight(const projection::Camera& camera) {
    return std::max(2, static_cast<int>(0.6 * camera.height));
}

std::vector<Tick> barTicks(const AnnotatedScene& scene, const projection::Camera& camera, const Sizes& sizes) {
    return BarScale(scene).ticks(std::max(2, barHeight(camera) / static_cast<int>(3 * sizes.text)));
}

/// Pixels from the bar's left side to the picture's right one.
double barRoom(const AnnotatedScene& scene, const projection::Camera& camera, const Sizes& sizes,
               const Overlay& overlay) {
    double numbers = 0.0;
    for (const Tick& tick : barTicks(scene, camera, sizes))
        numbers = std::max(numbers, overlay.textWidth(tick.label, sizes.text));
    return sizes.gap + numbers + 2.4 * sizes.text;
}

std::string captionOf(const AnnotationOptions& options, const AnnotatedScene& scene) {
    std::string caption = options.caption;
    const std::string word = "{field}";
    for (std::size_t at = caption.find(word); at != std::string::npos;
         at = caption.find(word, at + scene.fieldName.size()))
        caption.replace(at, word.size(), scene.fieldName);
    return caption;
}

/// A bar along the right side: the colour of each scalar, marks at isosurfaces, numbers, a caption above.
void drawColorBar(const std::string& caption, const AnnotatedScene& scene, const projection::Camera& camera,
                  const Sizes& sizes, Overlay& overlay) {
    const double barWidth = 1.2 * sizes.text, top = 0.2 * camera.height;
    const int height = barHeight(camera);
    const BarScale scale(scene);
    const std::vector<Tick> ticks = barTicks(scene, camera, sizes);
    const double left = camera.width - barRoom(scene, camera, sizes, overlay);
    const auto heightOf = [&](double scalar) { return top + height * (1.0 - scale.fractionOf(scalar)); };
    for (int row = 0; row < height; ++row) {
        const double scalar = scale.scalarAt(1.0 - (row + 0.5) / height);
        overlay.fill({left, std::floor(top) + row}, {barWidth, 1.0}, scene.transferFunction.colorAt(scalar));
    }
    for (const preint::Isosurface& surface : scene.transferFunction.isosurfaces) {
        if (surface.value < scene.low || surface.value > scene.high) continue;
        const double at = heightOf(surface.value);
        overlay.fill({left - sizes.gap, at - sizes.thinLine}, {barWidth + sizes.gap, 2.0 * sizes.thinLine},
                     surface.color);
    }
    overlay.frame({left, std::floor(top)}, {barWidth, static_cast<double>(height)}, sizes.thinLine);
    for (const Tick& tick : ticks) {
        const glm::dvec2 at(left + barWidth, heightOf(tick.value));
        overlay.line(at, at + glm::dvec2(sizes.gap, 0), sizes.thinLine);
        overlay.text(at + glm::dvec2(1.6 * sizes.gap, 0), tick.label, sizes.text, {0.0, 0.5});
    }
    const double most = 0.4 * camera.width;
    const double captionHeight = drawFitting(caption, {}, sizes.text, most, 1.0, false, overlay);
    drawFitting(caption, {camera.width - sizes.gap, top - sizes.gap - captionHeight}, sizes.text, most, 1.0, true,
                overlay);
}

}  // namespace

void addAnnotationOptions(CLI::App& command, AnnotationOptions& options) {
    command
        .add_option_function<std::string>(
            "--color-bar",
            [&options](const std::string& caption) {
                options.colorBar = true;
                options.caption = caption;
            },
            "a bar with the colours and numbers of the scalar, beside what shows where the view is fitted; the caption "
            "is "
            "{field} if nothing is said, such as \"Temperature in K\"")
        ->type_name("[CAPTION]")
        ->expected(0, 1)
        ->default_str("{field}");
    command.add_flag("--axes", options.axes, "the mesh's box with its coordinates");
    command.add_option("--title", options.title,
                       "text above the picture, in several lines where it is long; {time} and {step} are those of the "
                       "step of a series");
}

projection::Margins marginsFor(const AnnotationOptions& options, const AnnotatedScene& scene, int width, int height) {
    projection::Margins margins = projection::evenMargins(projection::defaultMargin, width, height);
    projection::Camera camera;
    camera.width = width;
    camera.height = height;
    const Sizes sizes(camera);
    Overlay overlay(1, 1, glm::dvec3(0));
    if (options.axes) {  // numbers and the axes' names stand about the box
        constexpr double sizesOfText = 4.6;
        const double wide = std::min(0.3, sizesOfText * sizes.text / width),
                     high = std::min(0.3, sizesOfText * sizes.text / height);
        margins = {wide, wide, high, high};
    }
    if (options.colorBar) margins.right += std::min(0.4, (barRoom(scene, camera, sizes, overlay) + sizes.gap) / width);
    if (!options.title.empty())
        margins.top += std::min(0.4, (titleHeight(options.title, camera, sizes, false, overlay) + sizes.gap) / height);
    return margins;
}

void drawBehind(const AnnotationOptions& options, const AnnotatedScene& scene, const projection::Camera& camera,
                projection::Image& image) {
    if (!options.axes) return;
    Overlay overlay = overlayFor(scene, camera);
    for (const BoxLine& line : axesBox(scene.bounds, camera).lines)
        if (line.behind) overlay.line(line.from, line.to, Sizes(camera).thinLine, boxOpacity);
    overlay.putUnder(image);
}

void drawInFront(const AnnotationOptions& options, const AnnotatedScene& scene, const projection::Camera& camera,
                 projection::Image& image) {
    if (options.empty()) return;
    const Sizes sizes(camera);
    Overlay overlay = overlayFor(scene, camera);
    if (options.axes) drawAxes(axesBox(scene.bounds, camera), sizes, overlay);
    if (options.colorBar) drawColorBar(captionOf(options, scene), scene, camera, sizes, overlay);
    if (!options.title.empty()) titleHeight(options.title, camera, sizes, true, overlay);
    overlay.putOver(image);
}

}  // namespace tetralux::apps
