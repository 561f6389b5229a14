// SPDX-License-Identifier: Apache-2.0
#include <projection/core/fitted_view.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <glm/geometric.hpp>

namespace tetralux::projection {

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

struct NamedView {
    const char* name;
    glm::dvec3 eyeSide, up;
};
constexpr glm::dvec3 xAxis{1, 0, 0}, yAxis{0, 1, 0}, zAxis{0, 0, 1};
const NamedView namedViews[] = {{"x", xAxis, zAxis},
                                {"-x", -xAxis, zAxis},
                                {"y", yAxis, zAxis},
                                {"-y", -yAxis, zAxis},
                                {"z", zAxis, yAxis},
                                {"-z", -zAxis, yAxis},
                                {"iso", {1, 1, 1}, zAxis},
                                // PyVista's words: the first letter to the right, the second up
                                {"xy", zAxis, yAxis},
                                {"yz", xAxis, zAxis},
                                {"zx", yAxis, xAxis},
                                {"yx", -zAxis, xAxis},
                                {"zy", -xAxis, yAxis},
                                {"xz", -yAxis, zAxis}};

glm::dvec3 unit(const glm::dvec3& v) {
    const double largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
    if (!(largest > 0.0) || !std::isfinite(largest))
        throw std::runtime_error("view: a direction is 0,0,0 or not finite; give one that points somewhere");
    return glm::normalize(v / largest);
}

/// `v` turned anticlockwise about the unit `axis` that points at who looks (Rodrigues).
glm::dvec3 rotated(const glm::dvec3& v, const glm::dvec3& axis, double degrees) {
    const double angle = degrees * std::numbers::pi / 180.0;
    return v * std::cos(angle) + glm::cross(axis, v) * std::sin(angle) +
           axis * (glm::dot(axis, v) * (1.0 - std::cos(angle)));
}

/// The frame of a view: forward, right, up, each of length 1.
struct Axes {
    glm::dvec3 forward, right, up;

    explicit Axes(const ViewDirection& view) : forward(unit(view.forward)), right(), up() {
        const glm::dvec3 across = glm::cross(forward, unit(view.up));
        if (!(glm::length(across) > 1e-9))
            throw std::runtime_error("view: up is along the direction of view; give another up");
        right = glm::normalize(across);
        up = glm::cross(right, forward);
    }
};

/// Least and largest of a quantity.
struct Extent {
    double low = infinite, high = -infinite;
    void include(double value) {
        low = std::min(low, value);
        high = std::max(high, value);
    }
    double middle() const { return 0.5 * low + 0.5 * high; }
    double length() const { return high - low; }
};

/// In one plane along the direction of view: where the eye stands across it, and how deep, so that all points lie
/// between the lines across = tangentLow·depth and tangentHigh·depth from it.
struct Wedge {
    double tangentLow, tangentHigh;
    double lowest = infinite, highest = -infinite;  // across − tangent·depth of the points

    void include(double across, double depth) {
        lowest = std::min(lowest, across - tangentLow * depth);
        highest = std::max(highest, across - tangentHigh * depth);
    }
    /// The deepest place from which both lines hold all.
    double deepest() const { return (lowest - highest) / (tangentHigh - tangentLow); }
    /// Midway between where the lines would let it stand.
    double acrossAt(double depth) const {
        return 0.5 * ((lowest + tangentLow * depth) + (highest + tangentHigh * depth));
    }
};

}  // namespace

ViewDirection namedView(const std::string& name) {
    std::vector<std::string> names;
    for (const NamedView& one : namedViews) {
        if (name == one.name) return {-one.eyeSide, one.up};
        names.emplace_back(one.name);
    }
    throw std::runtime_error(fmt::format("there is no view \"{}\"; take one of {}", name, fmt::join(names, ", ")));
}

std::vector<std::string> viewNames() {
    std::vector<std::string> names;
    for (const NamedView& one : namedViews) names.emplace_back(one.name);
    return names;
}

ViewDirection turned(const ViewDirection& view, const ViewTurn& turn) {
    ViewDirection result = view;
    result.forward = rotated(unit(result.forward), unit(result.up), turn.azimuth);
    if (turn.elevation != 0.0) result.forward = rotated(result.forward, -Axes(result).right, turn.elevation);
    if (turn.roll != 0.0) result.up = rotated(unit(result.up), unit(result.forward), turn.roll);
    return result;
}

Camera turned(const Camera& camera, const ViewTurn& turn) {
    const ViewDirection view = turned(ViewDirection{camera.target - camera.eye, camera.up}, turn);
    Camera result = camera;
    result.eye = camera.target - glm::length(camera.target - camera.eye) * unit(view.forward);
    result.up = view.up;
    return result;
}

Margins evenMargins(double share, int width, int height) {
    const double across = std::max(share, std::min(1.5 / width, 0.25));
    const double down = std::max(share, std::min(1.5 / height, 0.25));
    return {across, across, down, down};
}

Camera fitted(const Camera& camera, const ViewDirection& view, std::span<const glm::dvec3> points,
              const Margins& margins) {
    if (points.empty()) throw std::runtime_error("view: there is nothing to hold in it");
    const Axes axes(view);
    Extent depths, rights, ups;
    for (const glm::dvec3& p : points) {
        depths.include(glm::dot(p, axes.forward));
        rights.include(glm::dot(p, axes.right));
        ups.include(glm::dot(p, axes.up));
    }
    const double aspect = camera.aspect > 0 ? camera.aspect : static_cast<double>(camera.width) / camera.height;
    // What is free of the picture, from −1 to 1 each way about the optical axis.
    const glm::dvec2 low = camera.windowCentre + glm::dvec2(-1.0 + 2.0 * margins.left, -1.0 + 2.0 * margins.bottom);
    const glm::dvec2 high = camera.windowCentre + glm::dvec2(1.0 - 2.0 * margins.right, 1.0 - 2.0 * margins.top);
    if (!(low.x < high.x && low.y < high.y)) throw std::runtime_error("view: its margins leave no room");
    Camera result = camera;
    result.up = view.up;
    const auto place = [&](double right, double up, double depth) {
        return right * axes.right + up * axes.up + depth * axes.forward;
    };
    const double size = std::max({depths.length(), rights.length(), ups.length()});
    if (camera.orthographic()) {
        double height = 2.0 * std::max(ups.length() / (high.y - low.y), rights.length() / aspect / (high.x - low.x));
        if (!(height > 0.0)) height = size > 0.0 ? size : 1.0;
        result.orthographicHeight = height;
        const double right = rights.middle() - 0.25 * (low.x + high.x) * height * aspect,
                     up = ups.middle() - 0.25 * (low.y + high.y) * height;
        result.eye = place(right, up, depths.low - (size > 0.0 ? size : 1.0));
        result.target = place(right, up, depths.middle());
        return result;
    }
    const double tangent = std::tan(0.5 * camera.fovDegrees * std::numbers::pi / 180.0);
    Wedge across{low.x * tangent * aspect, high.x * tangent * aspect};
    Wedge upright{low.y * tangent, high.y * tangent};
    for (const glm::dvec3& p : points) {
        const double depth = glm::dot(p, axes.forward) - depths.low;  // no large numbers' differences
        across.include(glm::dot(p, axes.right) - rights.middle(), depth);
        upright.include(glm::dot(p, axes.up) - ups.middle(), depth);
    }
    double depth = std::min(across.deepest(), upright.deepest());
    if (!(size > 0.0)) depth = -1.0;  // a point
    // Not within what it looks at, nor so near that rounding shows: thin things along the direction of view.
    depth = std::min(depth, -1e-6 * size);
    // acrossAt() is of the eye: a point stands at across − tangent·(point's depth − eye's depth) from it.
    const double right = rights.middle() + across.acrossAt(depth), up = ups.middle() + upright.acrossAt(depth);
    result.eye = place(right, up, depths.low + depth);
    result.target = place(right, up, depths.middle());
    return result;
}

Camera zoomed(const Camera& camera, double factor) {
    if (!(factor > 0.0) || !std::isfinite(factor))
        throw std::runtime_error(fmt::format("zoom: {} will not do; give a factor above 0", factor));
    Camera result = camera;
    if (camera.orthographic())
        result.orthographicHeight /= factor;
    else
        result.fovDegrees = std::min(result.fovDegrees / factor, 179.0);
    return result;
}

}  // namespace tetralux::projection
