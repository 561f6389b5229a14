// SPDX-License-Identifier: Apache-2.0
#include <preint/table_texels.h>

#include <algorithm>
#include <cmath>

#include <preint/glsl_prelude.h>

namespace tetralux::preint {
namespace {

/// The mappings of table_lookup.glsl, of which no texel is read here.
struct Mapping {
    using real = double;
    using vec2 = glm::dvec2;
    using vec4 = glm::dvec4;
    static double log(double x) { return std::log(x); }
    static double exp(double x) { return std::exp(x); }
    static double min(double a, double b) { return std::min(a, b); }
    static double clamp(double x, double low, double high) { return std::clamp(x, low, high); }
    static vec4 tableTexel(double, double, double) { return vec4(0.0); }
    const vec2* tableZone = nullptr;
    double tableSize = 0, tableSlices = 0, tableLengthMax = 0, tableLengthScale = 1;
#define TETRALUX_DISCONTINUITIES 0
#define TETRALUX_SCALE_INVARIANT 0
#include <preint/table_lookup.glsl>
#undef TETRALUX_DISCONTINUITIES
#undef TETRALUX_SCALE_INVARIANT
};

}  // namespace

TableTexels::TableTexels(const ExactIntegral& exact, const PreintegrationTable& layout)
    : exact_(exact), layout_(layout) {
    const double extinction = exact.largestExtinction(layout.zones.front().x, layout.zones.back().y);
    thinLength_ = extinction > 0.0 ? 1e-9 / extinction : 1.0;
}

double TableTexels::lengthOf(int slice) const {
    if (slice == 0) return thinLength_;
    return Mapping().lengthOfFraction(Mapping().fractionOfTexel(slice + 0.5, layout_.slices), layout_.lengthMax,
                                      layout_.lengthScale);
}

glm::vec4 TableTexels::entry(const SegmentResult& segment, double path, double front, double back,
                             const glm::dvec2& zone) const {
    const double opacity = segment.opacity();
    constexpr double leastOpacity = 1e-290;  // below it the ratio has no digits left
    const glm::dvec3 color = opacity > leastOpacity ? segment.color / opacity
                                                    : exact_.nearestVisibleColor(std::min(front, back),
                                                                                 std::max(front, back), zone.x, zone.y);
    return glm::vec4(glm::dvec4(color, segment.opticalDepth / path));
}

glm::vec4 TableTexels::diagonal(double scalar, const glm::dvec2& zone) const {
    const bool fromAbove = scalar <= zone.x;
    const double extinction = (fromAbove ? exact_.valueFromAbove(scalar) : exact_.valueFromBelow(scalar)).extinction;
    const glm::dvec3 color = zone.x < zone.y ? exact_.nearestVisibleColor(scalar, scalar, zone.x, zone.y)
                                             : exact_.valueFromAbove(scalar).color;
    return glm::vec4(glm::dvec4(color, extinction));
}

glm::vec4 TableTexels::texel(int i, int row, int k) const {
    const std::size_t zoneIndex = static_cast<std::size_t>(row / layout_.size);
    const glm::dvec2& zone = layout_.zones[zoneIndex];
    const double front = layout_.texelScalars[zoneIndex * layout_.size + i], back = layout_.texelScalars[row];
    if (front == back) return diagonal(front, zone);
    const bool standard = layout_.integral == Integral::Standard;
    const double path = standard ? lengthOf(k) : std::abs(back - front);
    return entry(exact_.smoothSegment(front, back, path, layout_.integral), path, front, back, zone);
}

}  // namespace tetralux::preint
