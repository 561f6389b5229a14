// SPDX-License-Identifier: Apache-2.0
/// \file
/// The light of one segment for the quick variants: shares A and B of C·A + α·B, where A gathers ambient, diffuse and
/// transmitted light, which have the material's colour, and B highlights. Included once per instruction set.
///
/// Plain lights (ShadingSettings::plain): a lobe about the reflected direction r = 2n(n·l) − l or about −l is looked at
/// along v = −d, so that it is a product of the pixel's ray with one of two directions that the cell knows.
///
/// Local lights (point, head and coloured lights, Phong or Blinn–Phong, shading/light_model.glsl): all of it follows
/// from three cosines. With a = |n·l| and b = |n·v|, light that is reflected has Phong's cosine 2ab − l·v and Blinn and
/// Phong's (a + b)/√(2 + 2 l·v); what goes through has −l·v with either.
#include <projection/cpu/cpu_shading_vectors.h>

#include <cmath>

#include <projection/cpu/cpu_special_cell.h>
#include <projection/cpu/cpu_tile.h>

#if defined(TETRALUX_CPU_LOCAL_LIGHTS_H) == defined(HWY_TARGET_TOGGLE)
#ifdef TETRALUX_CPU_LOCAL_LIGHTS_H
#undef TETRALUX_CPU_LOCAL_LIGHTS_H
#else
#define TETRALUX_CPU_LOCAL_LIGHTS_H
#endif

HWY_BEFORE_NAMESPACE();
namespace tetralux::projection::HWY_NAMESPACE {

/// What a variant needs of one cell.
struct CellVariant {
    std::size_t j;                              ///< its place in the batch
    float gradient;                             ///< |g|, scene scalars per scene length
    float steepness, perSteepness;              ///< |g|·|z_c|, and one over it (0 where that is 0)
    float lengthScale;                          ///< of Segments::length
    float normal[3];                            ///< (right, down, forward)
    float lightSide[QuickVariant::mostLights];  ///< n·l
    /// −r, (right, down, forward): its product with the pixel's unit direction is r·v.
    float reflected[QuickVariant::mostLights][3];
};

template <ShadingVariant variant, bool ScaleInvariant>
HWY_INLINE void setVariant(const QuickVariant& quick, const CellBatch& batch, std::size_t j, CellVariant& cell) {
    cell.j = j;
    cell.gradient = batch.gradient[j];
    cell.steepness = batch.gradient[j] * std::abs(batch.scale[j]);
    cell.perSteepness = cell.steepness > 0 ? 1 / cell.steepness : 0;
    cell.lengthScale = ScaleInvariant ? batch.gradient[j] * batch.scale[j] : batch.scale[j];
    if constexpr (variant == ShadingVariant::Silhouettes) return;
    const float n[3] = {batch.normal[0][j], batch.normal[1][j], batch.normal[2][j]};
    if constexpr (variant == ShadingVariant::LocalLights) {
        for (std::size_t axis = 0; axis < 3; ++axis) cell.normal[axis] = n[axis];
    }
    for (std::size_t i = 0; i < quick.lights; ++i) {
        const auto& light = quick.localLights[i].place;
        const float side = n[0] * light[0] + n[1] * light[1] + n[2] * light[2];
        cell.lightSide[i] = side;
        for (std::size_t axis = 0; axis < 3; ++axis) cell.reflected[i][axis] = light[axis] - 2 * side * n[axis];
    }
}

/// What a variant needs of a block's pixels.
struct BlockVariant {
    real fall;                ///< scalarFall: its sign is that of s_f − s_b, which is that of v·n
    real rayLength, inverse;  ///< per unit depth, and one over it
    real x, y;                ///< unit direction of a ray: inverse·(x, y, 1), (right, down, forward)
    vec3 place;               ///< of the segments' middles (middlePlace): where QuickVariant::places
};

/// For a ≥ 0. Whole exponents by squaring.
HWY_INLINE real lobeOf(const QuickVariant& variant, real cosine) {
    if (none(cosine > real(variant.leastCosine))) return real(0.0f);
    const real base = max(cosine, real(0.0f));
    if (HWY_UNLIKELY(variant.wholeExponent == 0))
        return exp(real(variant.exponent) * real(hn::Log(FloatTag(), max(base, real(1e-30f)).v)));
    real power(1.0f), square = base;
    for (unsigned rest = variant.wholeExponent;;) {
        if (rest & 1u) power = power * square;
        if ((rest >>= 1) == 0) return power;
        square = square * square;
    }
}

HWY_INLINE real cosineTo(const float (&direction)[3], const BlockVariant& block) {
    return block.inverse * (real(direction[0]) * block.x + (real(direction[1]) * block.y + real(direction[2])));
}

/// A and B of the segment's light, one for all channels or one for each.
template <ShadingVariant variant>
struct LightShares {
    static constexpr std::size_t channels = variant == ShadingVariant::LocalLights ? 3 : 1;
    real colors[channels], whites[channels];

    HWY_INLINE real color(std::size_t channel) const { return colors[channel % channels]; }
    HWY_INLINE real white(std::size_t channel) const { return whites[channel % channels]; }
};

HWY_INLINE LightShares<ShadingVariant::Lit> plainShares(const QuickVariant& variant, const CellVariant& cell,
                                                        const BlockVariant& block, mask live, real opacity) {
    const real zero(0.0f), through = variant.transmission ? real(1.0f) - opacity : zero;
    real color(variant.ambient[0]), white = zero;
    for (std::size_t i = 0; i < variant.lights; ++i) {
        const real facing = block.fall * real(cell.lightSide[i]), amount(std::abs(cell.lightSide[i]));
        const mask reflects = both(live, facing > zero), transmits = both(live, facing < zero);
        if (!none(reflects)) {
            color += keep(reflects, amount);
            white = white + keep(reflects, lobeOf(variant, cosineTo(cell.reflected[i], block)));
        }
        if (variant.transmission && !none(transmits)) {
            color +=
                keep(transmits, through) * (amount + lobeOf(variant, cosineTo(variant.localLights[i].place, block)));
        }
    }
    return {{color}, {white}};
}

/// How one local light's light meets the segments' middles.
struct LocalLightTerm {
    real facing;    ///< a number with the sign of (l·n)(v·n)
    real amount;    ///< |n·l|
    real toView;    ///< l·v
    real strength;  ///< what distance leaves of it
};

HWY_INLINE LocalLightTerm lightOf(const QuickVariant& variant, std::size_t i, const CellVariant& cell,
                                  const BlockVariant& block, real viewSide) {
    const QuickLight& localLight = variant.localLights[i];
    const real one(1.0f);
    if (localLight.kind == 0)
        return {block.fall * real(cell.lightSide[i]), real(std::abs(cell.lightSide[i])),
                -cosineTo(localLight.place, block), one};
    LocalLightTerm light{abs(block.fall), viewSide, one, one};
    if (localLight.kind == 2 && !localLight.fades) return light;
    const vec3 way(real(localLight.place[0]) - block.place.x, real(localLight.place[1]) - block.place.y,
                   real(localLight.place[2]) - block.place.z);
    // the light at the eye of an orthographic view stands behind each pixel
    const real apart = variant.orthographic && localLight.kind == 2 ? way.z * way.z : dot(way, way);
    const real square = max(apart, real(1e-36f)), perReach = one / sqrt(square);
    if (localLight.fades)
        light.strength =
            one / max(real(localLight.fade[0]) +
                          square * perReach * (real(localLight.fade[1]) + square * perReach * real(localLight.fade[2])),
                      real(1e-30f));
    if (localLight.kind == 2) return light;
    const real side =
        perReach * (real(cell.normal[0]) * way.x + real(cell.normal[1]) * way.y + real(cell.normal[2]) * way.z);
    const real along = block.inverse * (block.x * way.x + block.y * way.y + way.z);
    light.facing = block.fall * side;
    light.amount = abs(side);
    light.toView = -(perReach * along);
    return light;
}

HWY_INLINE real halfwayCosine(real amount, real viewSide, real toView) {
    return (amount + viewSide) / sqrt(max(real(2.0f) + real(2.0f) * toView, real(1e-12f)));
}

HWY_INLINE LightShares<ShadingVariant::LocalLights> localLightShares(const QuickVariant& variant,
                                                                     const CellVariant& cell, const BlockVariant& block,
                                                                     mask live, real opacity) {
    const real zero(0.0f), two(2.0f);
    LightShares<ShadingVariant::LocalLights> shares;
    for (std::size_t c = 0; c < 3; ++c) {
        shares.colors[c] = real(variant.ambient[c]);
        shares.whites[c] = zero;
    }
    const real viewSide = abs(block.fall) * block.inverse * real(cell.perSteepness), left = real(1.0f) - opacity;
    for (std::size_t i = 0; i < variant.lights; ++i) {
        const LocalLightTerm light = lightOf(variant, i, cell, block, viewSide);
        const mask reflects = both(live, light.facing > zero), transmits = both(live, light.facing < zero);
        real colored = zero, specular = zero;
        if (!none(reflects)) {
            const real cosine = variant.halfway ? halfwayCosine(light.amount, viewSide, light.toView)
                                                : two * light.amount * viewSide - light.toView;
            colored = keep(reflects, real(variant.diffuse) * light.amount);
            specular = keep(reflects, real(variant.specular) * lobeOf(variant, cosine));
        }
        if (variant.transmission && !none(transmits)) {
            colored += keep(transmits, left) * (real(variant.diffuseThrough) * light.amount +
                                                real(variant.specularThrough) * lobeOf(variant, -light.toView));
        }
        const QuickLight& localLight = variant.localLights[i];
        colored = colored * light.strength;
        specular = specular * light.strength;
        for (std::size_t c = 0; c < 3; ++c) {
            shares.colors[c] += real(localLight.color[c]) * colored;
            shares.whites[c] += real(localLight.specular[c]) * specular;
        }
    }
    return shares;
}

template <ShadingVariant variant>
HWY_INLINE LightShares<variant> lightShares(const QuickVariant& quick, const CellVariant& cell,
                                            const BlockVariant& block, mask live, real opacity) {
    if constexpr (variant == ShadingVariant::LocalLights)
        return localLightShares(quick, cell, block, live, opacity);
    else
        return plainShares(quick, cell, block, live, opacity);
}

}  // namespace tetralux::projection::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
