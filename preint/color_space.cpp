// SPDX-License-Identifier: Apache-2.0
/// \file
/// CIELAB with the sRGB primaries and D65, as in VTK's vtkMath; Msh space after Moreland 2009, "Diverging Color Maps
/// for Scientific Visualization", as in vtkColorTransferFunction.
#include <preint/color_space.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace tetralux::preint {
namespace {

constexpr glm::dvec3 whiteD65{0.9505, 1.000, 1.089};

glm::dvec3 hsvFromRgb(const glm::dvec3& rgb) {
    const double high = std::max({rgb.x, rgb.y, rgb.z}), low = std::min({rgb.x, rgb.y, rgb.z});
    if (high <= low) return {0.0, 0.0, high};
    double hue;
    if (rgb.x == high) {
        hue = (rgb.y - rgb.z) / (high - low) / 6.0;
    } else if (rgb.y == high) {
        hue = 1.0 / 3.0 + (rgb.z - rgb.x) / (high - low) / 6.0;
    } else {
        hue = 2.0 / 3.0 + (rgb.x - rgb.y) / (high - low) / 6.0;
    }
    return {hue < 0.0 ? hue + 1.0 : hue, (high - low) / high, high};
}

glm::dvec3 rgbFromHsv(const glm::dvec3& hsv) {
    // Each channel is a trapezoid over the hue circle, shifted by a third.
    auto channel = [&](double shift) {
        const double position = std::fmod(hsv.x + shift, 1.0) * 6.0;
        const double level = std::clamp(std::abs(position - 3.0) - 1.0, 0.0, 1.0);
        return hsv.z * (1.0 - hsv.y * (1.0 - level));
    };
    return {channel(0.0), channel(2.0 / 3.0), channel(1.0 / 3.0)};
}

double linearFromDisplay(double value) {
    return value > 0.04045 ? std::pow((value + 0.055) / 1.055, 2.4) : value / 12.92;
}

double displayFromLinear(double value) {
    return value > 0.0031308 ? 1.055 * std::pow(value, 1.0 / 2.4) - 0.055 : 12.92 * value;
}

glm::dvec3 labFromRgb(const glm::dvec3& rgb) {
    const glm::dvec3 linear{linearFromDisplay(rgb.x), linearFromDisplay(rgb.y), linearFromDisplay(rgb.z)};
    const glm::dvec3 xyz{glm::dot(linear, {0.4124, 0.3576, 0.1805}), glm::dot(linear, {0.2126, 0.7152, 0.0722}),
                         glm::dot(linear, {0.0193, 0.1192, 0.9505})};
    auto compress = [](double value) { return value > 0.008856 ? std::cbrt(value) : 7.787 * value + 16.0 / 116.0; };
    const glm::dvec3 f{compress(xyz.x / whiteD65.x), compress(xyz.y / whiteD65.y), compress(xyz.z / whiteD65.z)};
    return {116.0 * f.y - 16.0, 500.0 * (f.x - f.y), 200.0 * (f.y - f.z)};
}

glm::dvec3 rgbFromLab(const glm::dvec3& lab) {
    const double y = (lab.x + 16.0) / 116.0;
    auto expand = [](double value) {
        const double cube = value * value * value;
        return cube > 0.008856 ? cube : (value - 16.0 / 116.0) / 7.787;
    };
    const glm::dvec3 xyz = whiteD65 * glm::dvec3{expand(y + lab.y / 500.0), expand(y), expand(y - lab.z / 200.0)};
    glm::dvec3 rgb{displayFromLinear(glm::dot(xyz, {3.2406, -1.5372, -0.4986})),
                   displayFromLinear(glm::dot(xyz, {-0.9689, 1.8758, 0.0415})),
                   displayFromLinear(glm::dot(xyz, {0.0557, -0.2040, 1.0570}))};
    // Out of gamut: scale down, as VTK does, so that the hue stays.
    const double high = std::max({rgb.x, rgb.y, rgb.z});
    if (high > 1.0) rgb /= high;
    return glm::max(rgb, 0.0);
}

/// (M, s, h): the polar form of Lab in which Moreland interpolates; s and h in radians.
glm::dvec3 mshFromLab(const glm::dvec3& lab) {
    const double magnitude = glm::length(lab);
    const double saturation = magnitude > 0.001 ? std::acos(lab.x / magnitude) : 0.0;
    return {magnitude, saturation, saturation > 0.001 ? std::atan2(lab.z, lab.y) : 0.0};
}

glm::dvec3 labFromMsh(const glm::dvec3& msh) {
    return msh.x * glm::dvec3{std::cos(msh.y), std::sin(msh.y) * std::cos(msh.z), std::sin(msh.y) * std::sin(msh.z)};
}

double angleBetween(double a, double b) {
    const double difference = std::fmod(std::abs(a - b), 2.0 * std::numbers::pi);
    return std::min(difference, 2.0 * std::numbers::pi - difference);
}

/// The hue that an unsaturated end takes so that the path to `saturated` is perceptually even (Moreland 2009, Figure
/// 9).
double adjustedHue(const glm::dvec3& saturated, double unsaturatedMagnitude) {
    if (saturated.x >= unsaturatedMagnitude - 0.1) return saturated.z;
    const double spin = saturated.y *
                        std::sqrt(unsaturatedMagnitude * unsaturatedMagnitude - saturated.x * saturated.x) /
                        (saturated.x * std::sin(saturated.y));
    return saturated.z > -0.3 * std::numbers::pi ? saturated.z + spin : saturated.z - spin;
}

glm::dvec3 interpolateDiverging(const glm::dvec3& first, const glm::dvec3& second, double fraction) {
    constexpr double leastSaturation = 0.05;
    glm::dvec3 a = mshFromLab(labFromRgb(first)), b = mshFromLab(labFromRgb(second));
    if (a.y > leastSaturation && b.y > leastSaturation && angleBetween(a.z, b.z) > 0.33 * std::numbers::pi) {
        const glm::dvec3 white{std::max({a.x, b.x, 88.0}), 0.0, 0.0};  // between distinct saturated colours lies white
        (fraction < 0.5 ? b : a) = white;
        fraction = fraction < 0.5 ? 2.0 * fraction : 2.0 * fraction - 1.0;
    }
    if (a.y < leastSaturation && b.y > leastSaturation) {
        a.z = adjustedHue(b, a.x);
    } else if (b.y < leastSaturation && a.y > leastSaturation) {
        b.z = adjustedHue(a, b.x);
    }
    return rgbFromLab(labFromMsh(glm::mix(a, b, fraction)));
}

glm::dvec3 interpolateHsv(const glm::dvec3& first, const glm::dvec3& second, double fraction, bool wrapped) {
    glm::dvec3 a = hsvFromRgb(first), b = hsvFromRgb(second);
    if (wrapped && std::abs(a.x - b.x) > 0.5) (a.x > b.x ? a : b).x -= 1.0;
    glm::dvec3 hsv = glm::mix(a, b, fraction);
    if (hsv.x < 0.0) hsv.x += 1.0;
    return rgbFromHsv(hsv);
}

/// Appends nodes of (low, high] until linear RGB follows the space's own path.
void subdivide(ColorSpace space, const ColorNode& low, const ColorNode& high, double from, double to, int depth,
               std::vector<ColorNode>& nodes) {
    constexpr double tolerance = 1.0 / 1024.0;
    constexpr int leastDepth = 2, mostDepth = 9;
    auto at = [&](double t) { return interpolateColor(space, low.color, high.color, t); };
    bool straight = depth >= leastDepth;
    for (double part = 0.25; straight && part < 1.0; part += 0.25) {
        const glm::dvec3 gap = glm::abs(at(std::lerp(from, to, part)) - glm::mix(at(from), at(to), part));
        straight = std::max({gap.x, gap.y, gap.z}) <= tolerance;
    }
    if (straight || depth >= mostDepth) {
        const double scalar = std::lerp(low.scalar, high.scalar, to);
        nodes.push_back({scalar, to == 1.0 ? high.color : at(to)});
        return;
    }
    const double middle = 0.5 * (from + to);
    subdivide(space, low, high, from, middle, depth + 1, nodes);
    subdivide(space, low, high, middle, to, depth + 1, nodes);
}

}  // namespace

glm::dvec3 interpolateColor(ColorSpace space, const glm::dvec3& first, const glm::dvec3& second, double fraction) {
    glm::dvec3 color{0.0};
    switch (space) {
        case ColorSpace::Rgb:
            color = glm::mix(first, second, fraction);
            break;
        case ColorSpace::Hsv:
            color = interpolateHsv(first, second, fraction, false);
            break;
        case ColorSpace::HsvWrapped:
            color = interpolateHsv(first, second, fraction, true);
            break;
        case ColorSpace::Lab:
            color = rgbFromLab(glm::mix(labFromRgb(first), labFromRgb(second), fraction));
            break;
        case ColorSpace::Diverging:
            color = interpolateDiverging(first, second, fraction);
            break;
        case ColorSpace::Step:
            color = fraction > 0.0 ? second : first;
            break;  // VTK: the colour of the next node
    }
    return glm::clamp(color, 0.0, 1.0);
}

std::vector<ColorNode> sampledInRgb(ColorSpace space, const std::vector<ColorNode>& nodes) {
    if (space == ColorSpace::Rgb || nodes.empty()) return nodes;
    std::vector<ColorNode> sampled{nodes.front()};
    for (std::size_t i = 1; i < nodes.size(); ++i) {
        const ColorNode &low = nodes[i - 1], &high = nodes[i];
        if (space == ColorSpace::Step) {
            sampled.push_back({low.scalar, high.color});
            sampled.push_back(high);
        } else if (low.scalar == high.scalar || low.color == high.color) {
            sampled.push_back(high);
        } else {
            subdivide(space, low, high, 0.0, 1.0, 0, sampled);
        }
    }
    return sampled;
}

}  // namespace tetralux::preint
