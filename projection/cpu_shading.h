// SPDX-License-Identifier: Apache-2.0
/// \file
/// Silhouettes and light for a block of segments: shading/cell_shading.glsl in SIMD lanes. Included once per
/// instruction set; only kernels for scenes that ask for it hold any of this.
#include <projection/cpu_segment.h>

#include <hwy/contrib/math/math-inl.h>

#include <projection/cpu_special_cell.h>
#include <projection/cpu_tile.h>

#if defined(TETRALUX_CPU_SHADING_H) == defined(HWY_TARGET_TOGGLE)
#ifdef TETRALUX_CPU_SHADING_H
#undef TETRALUX_CPU_SHADING_H
#else
#define TETRALUX_CPU_SHADING_H
#endif

HWY_BEFORE_NAMESPACE();
namespace tetralux::projection::HWY_NAMESPACE {

struct vec3 {
    real x, y, z;
    vec3() = default;
    HWY_INLINE vec3(real a, real b, real c) : x(a), y(b), z(c) {}
    HWY_INLINE explicit vec3(real a) : x(a), y(a), z(a) {}
};
HWY_INLINE vec3 operator+(vec3 a, vec3 b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
HWY_INLINE vec3 operator-(vec3 a, vec3 b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
HWY_INLINE vec3 operator-(vec3 a) {
    return {-a.x, -a.y, -a.z};
}
HWY_INLINE vec3 operator*(real a, vec3 b) {
    return {a * b.x, a * b.y, a * b.z};
}
HWY_INLINE vec3 operator*(vec3 a, real b) {
    return b * a;
}
HWY_INLINE real dot(vec3 a, vec3 b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
HWY_INLINE vec3 select(mask m, vec3 a, vec3 b) {
    return {select(m, a.x, b.x), select(m, a.y, b.y), select(m, a.z, b.z)};
}
HWY_INLINE real exp(real a) {
    return hn::Exp(FloatTag(), a.v);
}
HWY_INLINE real log(real a) {
    return hn::Log(FloatTag(), a.v);
}
/// For a ≥ 0.
HWY_INLINE real pow(real a, real exponent) {
    return exp(exponent * log(max(a, real(1e-30f))));
}

#include <shading/cell_shading.glsl>

/// Colour per α and α of one segment.
struct ShadedSegment {
    real r, g, b, opacity;
};

/// 1 − exp(−depth) with the relative precision of float.
HWY_INLINE real opacityOfDepth(real depth) {
    return select(depth < pieceDepthLimit(), pieceOpacity(min(depth, pieceDepthLimit())), real(1.0f) - exp(-depth));
}

/// `towards`: the unit direction of each pixel's ray. `front`, `back`: scalars; `length` in scene lengths.
template <bool ScaleInvariant>
HWY_INLINE ShadedSegment shadeSegment(const TileFrame& frame, const CellBatch& batch, std::size_t j,
                                      const SegmentSink& sink, const Segments& segments, vec3 towards) {
    const auto& shading = *frame.shading;
    const real magnitude(batch.gradient[j]);
    const vec3 normal{real(batch.normal[0][j]), real(batch.normal[1][j]), real(batch.normal[2][j])};
    real depth = sink.smoothDepth + sink.otherDepth;
    const real inverse = select(sink.opacity > real(0.0f), real(1.0f) / max(sink.opacity, real(1e-37f)), real(0.0f));
    vec3 mean = inverse * vec3(sink.r, sink.g, sink.b);
    if (shading.silhouette && batch.gradient[j] > 0) {
        const real cosine = dot(normal, towards);
        if constexpr (ScaleInvariant) {
            const real variation = abs(segments.back - segments.front);
            const real extinction =
                select(variation > real(0.0f), sink.smoothDepth / max(variation, real(1e-37f)), real(0.0f));
            depth = silhouetteDepth(extinction * magnitude * segments.length, sink.otherDepth, cosine);
        } else {
            depth = silhouetteDepth(real(0.0f), depth, cosine);
        }
    }
    const real opacity = opacityOfDepth(depth);
    if (!shading.lit()) return {mean.x, mean.y, mean.z, opacity};

    vec3 light = real(shading.ambient) * mean;
    if (batch.gradient[j] > 0) {
        const real fall = segments.front - segments.back;
        const real side = select(fall > real(0.0f), real(1.0f), select(fall < real(0.0f), real(-1.0f), real(0.0f)));
        const real transmitted = shading.transmission ? real(1.0f) - opacity : real(0.0f);
        for (const auto& source : frame.lights)
            light = light + lightTerm(mean, normal, -towards, vec3(real(source[0]), real(source[1]), real(source[2])),
                                      side, transmitted, real(shading.exponent));
    }
    return {light.x, light.y, light.z, opacity};
}

}  // namespace tetralux::projection::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
