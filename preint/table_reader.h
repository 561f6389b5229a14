// SPDX-License-Identifier: Apache-2.0
/// \file
/// The shared look-up texts in double precision over anything that yields texels: a finished table, or texels computed
/// when asked for.
#pragma once

#include <cmath>
#include <vector>

#include <preint/glsl_prelude.h>
#include <preint/preintegration_table.h>

namespace tetralux::preint {

/// What the look-up texts read beside texels.
struct TableUniforms {
    explicit TableUniforms(const PreintegrationTable& table)
        : tableSize(table.size),
          tableSlices(table.slices),
          tableLengthMax(table.lengthMax),
          tableLengthScale(table.lengthScale),
          tableZones(static_cast<int>(table.zones.size())),
          tableWarp(table.warp),
          tableRamp(table.ramps) {
        zoneAfter.push_back(0);
        for (const Discontinuity& one : table.discontinuities) {
            discontinuityValue.push_back(one.value);
            discontinuityLayer.emplace_back(one.color, -std::log1p(-one.opacity));
            zoneAfter.push_back(one.zoneAbove);
        }
    }
    double tableSize, tableSlices, tableLengthMax, tableLengthScale;
    int tableZones;
    std::vector<glm::dvec2> tableWarp;
    std::vector<glm::dvec3> tableRamp;
    std::vector<double> discontinuityValue;
    std::vector<glm::dvec4> discontinuityLayer;
    std::vector<int> zoneAfter;
};

// The texts' functions become members: they see the uniforms as GLSL functions see theirs. `Fetch` is called with whole
// texel coordinates (front, back including zone, slice) and returns a vec4.
#define TETRALUX_DISCONTINUITIES 1
#define TETRALUX_DISCONTINUITY_COUNT static_cast<int>(discontinuityValue.size())
#define TETRALUX_WARPS 1  // also where the mapping is linear: `warp` holds either
#define TETRALUX_WARP_COUNT static_cast<int>(tableWarp.size())
#define TETRALUX_RAMPS 1
#define TETRALUX_RAMP_COUNT static_cast<int>(tableRamp.size())
#define TETRALUX_TABLE_READER(name, texelFunction)                                      \
    using real = double;                                                                \
    using vec3 = glm::dvec3;                                                            \
    using vec4 = glm::dvec4;                                                            \
    Fetch fetch;                                                                        \
    name(const PreintegrationTable& table, Fetch f) : TableUniforms(table), fetch(f) {} \
    glm::dvec4 tableTexel(double u, double v, double w) {                               \
        return texelFunction;                                                           \
    }

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-parameter"  // each variant of the texts leaves some unread
namespace reader {

using namespace tetralux::glsl;

/// Texel coordinate → lower texel and weight of the upper one, as a clamp-to-edge sampler sees them.
struct Position {
    int low, high;
    double weight;
    Position(double coordinate, int size) {
        const double shifted = std::min(std::max(coordinate - 0.5, 0.0), size - 1.0);
        low = std::min(static_cast<int>(shifted), size - 1);
        high = std::min(low + 1, size - 1);
        weight = shifted - low;
    }
};

template <class Fetch>
glm::dvec4 bilinear(Fetch& fetch, const Position& u, const Position& v, int slice) {
    const glm::dvec4 low = glm::mix(fetch(u.low, v.low, slice), fetch(u.high, v.low, slice), u.weight);
    if (v.weight == 0.0) return low;
    return glm::mix(low, glm::mix(fetch(u.low, v.high, slice), fetch(u.high, v.high, slice), u.weight), v.weight);
}

template <class Fetch>
struct ScaleInvariant : TableUniforms {
    TETRALUX_TABLE_READER(ScaleInvariant,
                          (static_cast<void>(w), bilinear(fetch, Position(u, columns()), Position(v, rows()), 0)))
    int columns() const { return static_cast<int>(tableSize); }
    int rows() const { return columns() * tableZones; }
#define TETRALUX_SCALE_INVARIANT 1
#include <preint/gather_segment.glsl>
#include <preint/table_lookup.glsl>
#undef TETRALUX_SCALE_INVARIANT
};

template <class Fetch>
struct Standard : TableUniforms {
    TETRALUX_TABLE_READER(Standard, trilinear(Position(u, columns()), Position(v, rows()),
                                              Position(w, static_cast<int>(tableSlices))))
    int columns() const { return static_cast<int>(tableSize); }
    int rows() const { return columns() * tableZones; }
    glm::dvec4 trilinear(const Position& u, const Position& v, const Position& w) {
        const glm::dvec4 low = bilinear(fetch, u, v, w.low);
        return w.weight == 0.0 ? low : glm::mix(low, bilinear(fetch, u, v, w.high), w.weight);
    }
#define TETRALUX_SCALE_INVARIANT 0
#include <preint/gather_segment.glsl>
#include <preint/table_lookup.glsl>
#undef TETRALUX_SCALE_INVARIANT
};

}  // namespace reader
#pragma GCC diagnostic pop

#undef TETRALUX_TABLE_READER
#undef TETRALUX_RAMP_COUNT
#undef TETRALUX_RAMPS
#undef TETRALUX_WARP_COUNT
#undef TETRALUX_WARPS
#undef TETRALUX_DISCONTINUITY_COUNT
#undef TETRALUX_DISCONTINUITIES

/// Looks segments up in `table`'s layout with texels from `fetch(front, back, slice)`.
template <class Fetch>
class TableReader {
public:
    TableReader(const PreintegrationTable& table, Fetch fetch)
        : integral_(table.integral), scaleInvariant_(table, fetch), standard_(table, fetch) {}

    SegmentResult segment(double front, double back, double length) {
        return integral_ == Integral::ScaleInvariant ? resultOf(scaleInvariant_.gatherSegment(front, back, length))
                                                     : resultOf(standard_.gatherSegment(front, back, length));
    }

private:
    template <class Gathered>
    static SegmentResult resultOf(const Gathered& gathered) {
        const double depth = gathered.smoothDepth + gathered.otherDepth;
        return {gathered.meanColor * -std::expm1(-depth), depth};
    }

    Integral integral_;
    reader::ScaleInvariant<Fetch> scaleInvariant_;
    reader::Standard<Fetch> standard_;
};

}  // namespace tetralux::preint
