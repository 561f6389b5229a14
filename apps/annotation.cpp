// SPDX-License-Identifier: Apache-2.0
#include <apps/annotation.h>

#include <algorithm>
#include <cmath>

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

void drawTitle(const std::string& title, const projection::Camera& camera, const Sizes& sizes, Overlay& overlay) {
    overlay.text({0.5 * camera.width, sizes.gap}, title, 1.4 * sizes.text, {0.5, 0.0});
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

/// A bar along the right side: the colour of each scalar, marks at isosurfaces, numbers, the field's name above.
void drawColorBar(const AnnotatedScene& scene, const projection::Camera& camera, const Sizes& sizes, Overlay& overlay) {
    const double barWidth = 1.2 * sizes.text, top = 0.2 * camera.height;
    const int height = std::max(2, static_cast<int>(0.6 * camera.height));
    const std::vector<Tick> ticks =
        niceTicks(scene.low, scene.high, std::max(2, height / static_cast<int>(3 * sizes.text)));
    double numbers = 0.0;
    for (const Tick& tick : ticks) numbers = std::max(numbers, overlay.textWidth(tick.label, sizes.text));
    const double left = camera.width - sizes.gap - numbers - 1.2 * sizes.text - barWidth;
    const auto heightOf = [&](double scalar) {
        const double fraction = scene.high > scene.low ? (scalar - scene.low) / (scene.high - scene.low) : 0.5;
        return top + height * (1.0 - fraction);
    };
    for (int row = 0; row < height; ++row) {
        const double scalar = std::lerp(scene.high, scene.low, (row + 0.5) / height);
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
    overlay.text({camera.width - sizes.gap, top - sizes.gap}, scene.fieldName, sizes.text, {1.0, 1.0});
}

}  // namespace

void addAnnotationOptions(CLI::App& command, AnnotationOptions& options) {
    command.add_flag("--color-bar", options.colorBar, "a bar with the colours and numbers of the scalar");
    command.add_flag("--axes", options.axes, "the mesh's box with its coordinates");
    command.add_option("--title", options.title, "a line of text above the picture");
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
    if (options.colorBar) drawColorBar(scene, camera, sizes, overlay);
    if (!options.title.empty()) drawTitle(options.title, camera, sizes, overlay);
    overlay.putOver(image);
}

}  // namespace tetralux::apps
