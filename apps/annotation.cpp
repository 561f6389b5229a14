// SPDX-License-Identifier: Apache-2.0
#include <apps/annotation.h>

#include <algorithm>
#include <cmath>

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

/// A bar along the right side: the colour of each scalar, marks at isosurfaces, numbers, the field's name above.
void drawColorBar(const AnnotatedScene& scene, const projection::Camera& camera, const Sizes& sizes, Overlay& overlay) {
    const double barWidth = 1.2 * sizes.text, top = 0.2 * camera.height;
    const int height = std::max(2, static_cast<int>(0.6 * camera.height));
    const BarScale scale(scene);
    const std::vector<Tick> ticks = scale.ticks(std::max(2, height / static_cast<int>(3 * sizes.text)));
    double numbers = 0.0;
    for (const Tick& tick : ticks) numbers = std::max(numbers, overlay.textWidth(tick.label, sizes.text));
    const double left = camera.width - sizes.gap - numbers - 1.2 * sizes.text - barWidth;
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
