// SPDX-License-Identifier: Apache-2.0
/// \file
/// Silhouettes and light for a block of segments: shading/cell_shading.glsl in SIMD lanes. Included once per
/// instruction set; only kernels for scenes that ask for it hold any of this.
#include <projection/cpu/cpu_light.h>
#include <projection/cpu/cpu_shading_vectors.h>

#if defined(TETRALUX_CPU_SHADING_H) == defined(HWY_TARGET_TOGGLE)
#ifdef TETRALUX_CPU_SHADING_H
#undef TETRALUX_CPU_SHADING_H
#else
#define TETRALUX_CPU_SHADING_H
#endif

HWY_BEFORE_NAMESPACE();
namespace tetralux::projection::HWY_NAMESPACE {

#include <shading/cell_shading.glsl>
#include <shading/silhouette.glsl>

/// Colour per α and α of one segment.
struct ShadedSegment {
    real r, g, b, opacity, depth;
};

/// Depth-based colouring (shading::DepthColor). `beyond`: distance along the rays less TileFrame::depthReference, scene
/// lengths.
HWY_INLINE void colorByDepth(const TileFrame& frame, real beyond, ShadedSegment& segment) {
    const shading::DepthColor& depthColor = *frame.shading->depthColor;
    const real grey = real(frame.greyPerDistance) * beyond + real(frame.greyOfReference);
    const real share = real(depthColor.strength) * clamp(real(1.0f) - grey, real(0.0f), real(1.0f));
    segment.r += share * (real(depthColor.color.x) - segment.r);
    segment.g += share * (real(depthColor.color.y) - segment.g);
    segment.b += share * (real(depthColor.color.z) - segment.b);
}

/// 1 − exp(−depth) with the relative precision of float.
HWY_INLINE real opacityOfDepth(real depth) {
    return select(depth < pieceDepthLimit(), pieceOpacity(min(depth, pieceDepthLimit())), real(1.0f) - exp(-depth));
}

/// Makes opacity and depth no number where floats, which hold the cosine n·d to some 2e-7, do not hold what silhouettes
/// make of them to 1e-4. In the first hit neither shows.
HWY_INLINE void vouch(const TileFrame& frame, real cosine, mask live, real& depth, real& opacity) {
    if (frame.kind == TileKind::FirstHit) return;
    constexpr float rounding = 2e-7f, largestError = 1e-4f;
    const mask grazing = both(live, abs(cosine) < real(rounding / largestError));
    if (HWY_LIKELY(none(grazing))) return;
    const real change = depth * real(rounding) / max(abs(cosine), real(1e-30f));
    const real seen = frame.kind == TileKind::Additive ? real(1.0f) / max(depth, real(1.0f)) : real(1.0f) - opacity;
    const mask isUncertainPixel = both(grazing, change * seen > real(largestError));
    opacity = select(isUncertainPixel, unsure(), opacity);
    depth = select(isUncertainPixel, unsure(), depth);
}

/// `towards`: the unit direction of each pixel's ray, (right, down, forward). `fall` has the sign of s_f − s_b.
/// `middles()` and `place()` give where the segments' middles lie (cpu_light.h), which only light in full asks.
template <bool ScaleInvariant, class Middles, class Place>
HWY_INLINE ShadedSegment shadeSegment(const TileFrame& frame, const CellBatch& batch, std::size_t j,
                                      const SegmentAccumulator& accumulator, const Segments& segments, real fall,
                                      vec3 towards, const Middles& middles, const Place& place,
                                      const vec3* cut = nullptr) {
    const auto& shading = *frame.shading;
    const real magnitude(batch.gradient[j]);
    const vec3 normal{real(batch.normal[0][j]), real(batch.normal[1][j]), real(batch.normal[2][j])};
    real plainDepth = accumulator.smoothDepth + accumulator.otherDepth, depth = plainDepth;
    const real inverse =
        select(accumulator.opacity > real(0.0f), real(1.0f) / max(accumulator.opacity, real(1e-37f)), real(0.0f));
    vec3 mean = inverse * vec3(accumulator.r, accumulator.g, accumulator.b);
    const bool enhanced = shading.silhouette && (frame.smoothSilhouettes || batch.gradient[j] > 0);
    if (enhanced) {
        real cosine, steepness;
        if (HWY_UNLIKELY(frame.smoothSilhouettes)) {
            const SmoothSlope slope = smoothSlope(frame, batch, j, middles(), towards);
            cosine = slope.cosine;
            steepness = slope.magnitude;
        } else {
            cosine = dot(normal, towards);
            steepness = magnitude;
        }
        if constexpr (ScaleInvariant) {
            const real extinction = accumulator.smoothDepth / variationOf(segments);
            depth = silhouetteDepth(extinction * steepness * segments.length, accumulator.otherDepth, cosine);
        } else {
            depth = silhouetteDepth(real(0.0f), depth, cosine);
        }
    }
    real factor(1.0f);
    if (shading.gradientOpacity > 0) factor = real(shading.gradientOpacity) * magnitude;  // Levoy's
    if (frame.classification == Classification::PostLinear) factor = factor * linearDepthFactor(factor * plainDepth);
    depth = depth * factor;
    plainDepth = plainDepth * factor;
    real opacity = opacityOfDepth(depth);
    if (shading.approximateSilhouette && enhanced)
        opacity = approximateSilhouetteOpacity(opacityOfDepth(plainDepth), plainDepth, depth);
    if (!ScaleInvariant && enhanced && !frame.smoothSilhouettes)
        vouch(frame, dot(normal, towards), segments.live, depth, opacity);
    if (!shading.lit()) return {mean.x, mean.y, mean.z, opacity, depth};

    real side = select(fall > real(0.0f), real(1.0f), select(fall < real(0.0f), real(-1.0f), real(0.0f)));
    if (cut != nullptr) side = real(1.0f);
    if (HWY_UNLIKELY(frame.lightInFull)) {
        const vec3 lit = lightInFull(frame, batch, j, middles(), place(),
                                     {mean, opacity, side, segments.front, segments.back, towards, cut});
        return {lit.x, lit.y, lit.z, opacity, depth};
    }
    vec3 light = real(shading.ambient) * mean;
    if (batch.gradient[j] > 0 || cut != nullptr) {
        const vec3 facing = cut != nullptr ? *cut : normal;
        const real transmitted = shading.transmission ? real(1.0f) - opacity : real(0.0f);
        for (const auto& source : frame.lights)
            light = light + lightTerm(mean, facing, -towards, vec3(real(source[0]), real(source[1]), real(source[2])),
                                      side, transmitted, real(shading.exponent));
    }
    return {light.x, light.y, light.z, opacity, depth};
}

}  // namespace tetralux::projection::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
