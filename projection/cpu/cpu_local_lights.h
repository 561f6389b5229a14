// SPDX-License-Identifier: Apache-2.0
/// \file
/// The light of one segment for the quick looks: shares A and B of C·A + α·B, where A gathers ambient, diffuse and
/// transmitted light, which have the material's colour, and B highlights. Included once per instruction set.
///
/// Plain lights (ShadingSettings::plain): a lobe about the reflected direction r = 2n(n·l) − l or about −l is looked at
/// along v = −d, so that it is a product of the pixel's ray with one of two directions that the cell knows.
///
/// Lamps (point, head and coloured lights, Phong or Blinn–Phong, shading/light_model.glsl): all of it follows from
/// three cosines. With a = |n·l| and b = |n·v|, light that is reflected has Phong's cosine 2ab − l·v and Blinn and
/// Phong's (a + b)/√(2 + 2 l·v); what goes through has −l·v with either.
#include <projection/cpu/cpu_shading_vectors.h>

#include <cmath>

#include <projection/cpu/cpu_special_cell.h>
#include <projection/cpu/cpu_tile.h>

#if defined(TETRALUX_CPU_LAMPS_H) == defined(HWY_TARGET_TOGGLE)
#ifdef TETRALUX_CPU_LAMPS_H
#undef TETRALUX_CPU_LAMPS_H
#else
#define TETRALUX_CPU_LAMPS_H
#endif

HWY_BEFORE_NAMESPACE();
namespace tetralux::projection::HWY_NAMESPACE {

/// What a look needs of one cell.
struct CellLook {
    std::size_t j;                           ///< its place in the batch
    float gradient;                          ///< |g|, scene scalars per scene length
    float steepness, perSteepness;           ///< |g|·|z_c|, and one over it (0 where that is 0)
    float lengthScale;                       ///< of Segments::length
    float normal[3];                         ///< (right, down, forward)
    float lightSide[QuickLook::mostLights];  ///< n·l
    /// −r, (right, down, forward): its product with the pixel's unit direction is r·v.
    float reflected[QuickLook::mostLights][3];
};

template <Look look, bool ScaleInvariant>
HWY_INLINE void setLook(const QuickLook& quick, const CellBatch& batch, std::size_t j, CellLook& cell) {
    cell.j = j;
    cell.gradient = batch.gradient[j];
    cell.steepness = batch.gradient[j] * std::abs(batch.scale[j]);
    cell.perSteepness = cell.steepness > 0 ? 1 / cell.steepness : 0;
    cell.lengthScale = ScaleInvariant ? batch.gradient[j] * batch.scale[j] : batch.scale[j];
    if constexpr (look == Look::Silhouettes) return;
    const float n[3] = {batch.normal[0][j], batch.normal[1][j], batch.normal[2][j]};
    if constexpr (look == Look::Lamps) {
        for (std::size_t axis = 0; axis < 3; ++axis) cell.normal[axis] = n[axis];
    }
    for (std::size_t i = 0; i < quick.lights; ++i) {
        const auto& light = quick.lamps[i].place;
        const float side = n[0] * light[0] + n[1] * light[1] + n[2] * light[2];
        cell.lightSide[i] = side;
        for (std::size_t axis = 0; axis < 3; ++axis) cell.reflected[i][axis] = light[axis] - 2 * side * n[axis];
    }
}

/// What a look needs of a block's pixels.
struct BlockLook {
    real fall;                ///< scalarFall: its sign is that of s_f − s_b, which is that of v·n
    real rayLength, inverse;  ///< per unit depth, and one over it
    real x, y;                ///< unit direction of a ray: inverse·(x, y, 1), (right, down, forward)
    vec3 place;               ///< of the segments' middles (middlePlace): where QuickLook::places
};

/// For a ≥ 0. Whole exponents by squaring.
HWY_INLINE real lobeOf(const QuickLook& look, real cosine) {
    if (none(cosine > real(look.leastCosine))) return real(0.0f);
    const real base = max(cosine, real(0.0f));
    if (HWY_UNLIKELY(look.wholeExponent == 0))
        return exp(real(look.exponent) * real(hn::Log(FloatTag(), max(base, real(1e-30f)).v)));
    real power(1.0f), square = base;
    for (unsigned rest = look.wholeExponent;;) {
        if (rest & 1u) power = power * square;
        if ((rest >>= 1) == 0) return power;
        square = square * square;
    }
}

HWY_INLINE real cosineTo(const float (&direction)[3], const BlockLook& block) {
    return block.inverse * (real(direction[0]) * block.x + (real(direction[1]) * block.y + real(direction[2])));
}

/// A and B of the segment's light, one for all channels or one for each.
template <Look look>
struct LightShares {
    static constexpr std::size_t channels = look == Look::Lamps ? 3 : 1;
    real colors[channels], whites[channels];

    HWY_INLINE real color(std::size_t channel) const { return colors[channel % channels]; }
    HWY_INLINE real white(std::size_t channel) const { return whites[channel % channels]; }
};

HWY_INLINE LightShares<Look::Lit> plainShares(const QuickLook& look, const CellLook& cell, const BlockLook& block,
                                              mask live, real opacity) {
    const real zero(0.0f), through = look.transmission ? real(1.0f) - opacity : zero;
    real color(look.ambient[0]), white = zero;
    for (std::size_t i = 0; i < look.lights; ++i) {
        const real facing = block.fall * real(cell.lightSide[i]), amount(std::abs(cell.lightSide[i]));
        const mask reflects = both(live, facing > zero), transmits = both(live, facing < zero);
        if (!none(reflects)) {
            color += keep(reflects, amount);
            white = white + keep(reflects, lobeOf(look, cosineTo(cell.reflected[i], block)));
        }
        if (look.transmission && !none(transmits)) {
            color += keep(transmits, through) * (amount + lobeOf(look, cosineTo(look.lamps[i].place, block)));
        }
    }
    return {{color}, {white}};
}

/// How one lamp's light meets the segments' middles.
struct LampLight {
    real facing;    ///< a number with the sign of (l·n)(v·n)
    real amount;    ///< |n·l|
    real toView;    ///< l·v
    real strength;  ///< what distance leaves of it
};

HWY_INLINE LampLight lightOf(const QuickLook& look, std::size_t i, const CellLook& cell, const BlockLook& block,
                             real viewSide) {
    const QuickLamp& lamp = look.lamps[i];
    const real one(1.0f);
    if (lamp.kind == 0)
        return {block.fall * real(cell.lightSide[i]), real(std::abs(cell.lightSide[i])), -cosineTo(lamp.place, block),
                one};
    LampLight light{abs(block.fall), viewSide, one, one};
    if (lamp.kind == 2 && !lamp.fades) return light;
    const vec3 way(real(lamp.place[0]) - block.place.x, real(lamp.place[1]) - block.place.y,
                   real(lamp.place[2]) - block.place.z);
    // the light at the eye of an orthographic view stands behind each pixel
    const real apart = look.orthographic && lamp.kind == 2 ? way.z * way.z : dot(way, way);
    const real square = max(apart, real(1e-36f)), perReach = one / sqrt(square);
    if (lamp.fades)
        light.strength =
            one /
            max(real(lamp.fade[0]) + square * perReach * (real(lamp.fade[1]) + square * perReach * real(lamp.fade[2])),
                real(1e-30f));
    if (lamp.kind == 2) return light;
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

HWY_INLINE LightShares<Look::Lamps> lampShares(const QuickLook& look, const CellLook& cell, const BlockLook& block,
                                               mask live, real opacity) {
    const real zero(0.0f), two(2.0f);
    LightShares<Look::Lamps> shares;
    for (std::size_t c = 0; c < 3; ++c) {
        shares.colors[c] = real(look.ambient[c]);
        shares.whites[c] = zero;
    }
    const real viewSide = abs(block.fall) * block.inverse * real(cell.perSteepness), left = real(1.0f) - opacity;
    for (std::size_t i = 0; i < look.lights; ++i) {
        const LampLight light = lightOf(look, i, cell, block, viewSide);
        const mask reflects = both(live, light.facing > zero), transmits = both(live, light.facing < zero);
        real colored = zero, specular = zero;
        if (!none(reflects)) {
            const real cosine = look.halfway ? halfwayCosine(light.amount, viewSide, light.toView)
                                             : two * light.amount * viewSide - light.toView;
            colored = keep(reflects, real(look.diffuse) * light.amount);
            specular = keep(reflects, real(look.specular) * lobeOf(look, cosine));
        }
        if (look.transmission && !none(transmits)) {
            colored += keep(transmits, left) * (real(look.diffuseThrough) * light.amount +
                                                real(look.specularThrough) * lobeOf(look, -light.toView));
        }
        const QuickLamp& lamp = look.lamps[i];
        colored = colored * light.strength;
        specular = specular * light.strength;
        for (std::size_t c = 0; c < 3; ++c) {
            shares.colors[c] += real(lamp.color[c]) * colored;
            shares.whites[c] += real(lamp.specular[c]) * specular;
        }
    }
    return shares;
}

template <Look look>
HWY_INLINE LightShares<look> lightShares(const QuickLook& quick, const CellLook& cell, const BlockLook& block,
                                         mask live, real opacity) {
    if constexpr (look == Look::Lamps)
        return lampShares(quick, cell, block, live, opacity);
    else
        return plainShares(quick, cell, block, live, opacity);
}

}  // namespace tetralux::projection::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
