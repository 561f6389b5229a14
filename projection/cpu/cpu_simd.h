// SPDX-License-Identifier: Apache-2.0
/// \file
/// SIMD lanes with operators, so that the shared texts (.glsl) compile for them: `real` is a vector of floats, one lane
/// per pixel, `wide` one of doubles, one lane per cell. Included once per instruction set (Highway's foreach_target).
/// Vector types of unknown size (SVE, RISC-V) cannot be members of a class: cpu_targets.h leaves those targets out.
#include <limits>

#include <hwy/highway.h>

#if defined(TETRALUX_CPU_SIMD_H) == defined(HWY_TARGET_TOGGLE)
#ifdef TETRALUX_CPU_SIMD_H
#undef TETRALUX_CPU_SIMD_H
#else
#define TETRALUX_CPU_SIMD_H
#endif

HWY_BEFORE_NAMESPACE();
namespace tetralux::projection::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// A tile's pixels lie in columns four wide, so a vector covers 4 × (lanes/4) of them: at most 4 × 4.
using FloatTag = hn::CappedTag<float, 16>;
using IntTag = hn::Rebind<std::int32_t, FloatTag>;
using DoubleTag = hn::CappedTag<double, 8>;
HWY_INLINE constexpr std::size_t laneCount() {
    return hn::MaxLanes(FloatTag());
}

/// What lanes of floats and of doubles have in common. Overloads of plain functions, not templates, so that products
/// and values of a whole cell convert.
#define TETRALUX_LANE_OPERATIONS(lanes, lane_mask)                      \
    HWY_INLINE lanes operator+(lanes a, lanes b) {                      \
        return hn::Add(a.v, b.v);                                       \
    }                                                                   \
    HWY_INLINE lanes operator-(lanes a, lanes b) {                      \
        return hn::Sub(a.v, b.v);                                       \
    }                                                                   \
    HWY_INLINE lanes operator/(lanes a, lanes b) {                      \
        return hn::Div(a.v, b.v);                                       \
    }                                                                   \
    HWY_INLINE lanes operator-(lanes a) {                               \
        return hn::Neg(a.v);                                            \
    }                                                                   \
    HWY_INLINE lane_mask operator<(lanes a, lanes b) {                  \
        return hn::Lt(a.v, b.v);                                        \
    }                                                                   \
    HWY_INLINE lane_mask operator>(lanes a, lanes b) {                  \
        return hn::Gt(a.v, b.v);                                        \
    }                                                                   \
    HWY_INLINE lanes abs(lanes a) {                                     \
        return hn::Abs(a.v);                                            \
    }                                                                   \
    HWY_INLINE lanes min(lanes a, lanes b) {                            \
        return hn::Min(a.v, b.v);                                       \
    }                                                                   \
    HWY_INLINE lanes max(lanes a, lanes b) {                            \
        return hn::Max(a.v, b.v);                                       \
    }                                                                   \
    HWY_INLINE lanes sqrt(lanes a) {                                    \
        return hn::Sqrt(a.v);                                           \
    }                                                                   \
    HWY_INLINE lanes select(lane_mask m, lanes ifTrue, lanes ifFalse) { \
        return hn::IfThenElse(m, ifTrue.v, ifFalse.v);                  \
    }

struct real;
/// A product that the next addition may take into a fused multiply-add.
struct product {
    hn::Vec<FloatTag> a, b;
};

struct real {
    hn::Vec<FloatTag> v;
    real() = default;
    HWY_INLINE real(hn::Vec<FloatTag> lanes) : v(lanes) {}
    HWY_INLINE real(product p) : v(hn::Mul(p.a, p.b)) {}
    HWY_INLINE explicit real(double value) : v(hn::Set(FloatTag(), static_cast<float>(value))) {}
    HWY_INLINE explicit real(float value) : v(hn::Set(FloatTag(), value)) {}
    HWY_INLINE explicit real(int value) : v(hn::Set(FloatTag(), static_cast<float>(value))) {}
};

/// The same for all pixels of a cell.
struct cell_real {
    float value;
    HWY_INLINE operator real() const { return real(value); }
};

using mask = hn::Mask<FloatTag>;
TETRALUX_LANE_OPERATIONS(real, mask)

HWY_INLINE product operator*(real a, real b) {
    return {a.v, b.v};
}
HWY_INLINE real operator+(real a, product p) {
    return hn::MulAdd(p.a, p.b, a.v);
}
HWY_INLINE real operator+(product p, real a) {
    return hn::MulAdd(p.a, p.b, a.v);
}
HWY_INLINE real operator+(product p, product q) {
    return hn::MulAdd(p.a, p.b, hn::Mul(q.a, q.b));
}
HWY_INLINE real operator-(real a, product p) {
    return hn::NegMulAdd(p.a, p.b, a.v);
}
HWY_INLINE real operator-(product p, real a) {
    return hn::MulSub(p.a, p.b, a.v);
}
HWY_INLINE real operator-(product p, product q) {
    return hn::MulSub(p.a, p.b, hn::Mul(q.a, q.b));
}
HWY_INLINE product operator*(product p, real a) {
    return {hn::Mul(p.a, p.b), a.v};
}
HWY_INLINE product operator*(real a, product p) {
    return {a.v, hn::Mul(p.a, p.b)};
}
HWY_INLINE product operator*(product p, product q) {
    return {hn::Mul(p.a, p.b), hn::Mul(q.a, q.b)};
}
HWY_INLINE real operator/(product p, real a) {
    return hn::Div(hn::Mul(p.a, p.b), a.v);
}
HWY_INLINE real& operator+=(real& a, real b) {
    return a = a + b;
}
HWY_INLINE real& operator+=(real& a, product p) {
    return a = a + p;
}
HWY_INLINE real& operator-=(real& a, product p) {
    return a = a - p;
}

HWY_INLINE mask operator==(real a, real b) {
    return hn::Eq(a.v, b.v);
}
HWY_INLINE mask both(mask a, mask b) {
    return hn::And(a, b);
}
HWY_INLINE mask either(mask a, mask b) {
    return hn::Or(a, b);
}
HWY_INLINE mask exactlyOne(mask a, mask b) {
    return hn::Xor(a, b);
}
HWY_INLINE bool none(mask m) {
    return hn::AllFalse(FloatTag(), m);
}
HWY_INLINE std::size_t count(mask m) {
    return hn::CountTrue(FloatTag(), m);
}

HWY_INLINE real floor(real a) {
    return hn::Floor(a.v);
}
HWY_INLINE real clamp(real a, real low, real high) {
    return hn::Min(hn::Max(a.v, low.v), high.v);
}
/// `a` where m, 0 elsewhere.
HWY_INLINE real keep(mask m, real a) {
    return hn::IfThenElseZero(m, a.v);
}
HWY_INLINE float largest(real a) {
    return hn::GetLane(hn::MaxOfLanes(FloatTag(), a.v));
}

/// Lanes that are no number: what a kernel cannot vouch for, which is composed again in double (exact_repair.h).
HWY_INLINE real unsure() {
    return hn::Set(FloatTag(), std::numeric_limits<float>::quiet_NaN());
}

/// 1/a to about 1e-7: the hardware's estimate and one Newton step (none needed where the estimate is a full division).
HWY_INLINE real reciprocal(real a) {
    const auto estimate = hn::ApproximateReciprocal(a.v);
    return hn::MulAdd(estimate, hn::NegMulAdd(a.v, estimate, real(1.0f).v), estimate);
}

HWY_INLINE real loadAligned(const float* from) {
    return hn::Load(FloatTag(), from);
}
HWY_INLINE real loadAt(const float* from) {
    return hn::LoadU(FloatTag(), from);
}
HWY_INLINE void storeAt(real a, float* to) {
    hn::StoreU(a.v, FloatTag(), to);
}

/// Doubles, one lane per cell.
struct wide {
    hn::Vec<DoubleTag> v;
    wide() = default;
    HWY_INLINE wide(hn::Vec<DoubleTag> lanes) : v(lanes) {}
    HWY_INLINE explicit wide(double value) : v(hn::Set(DoubleTag(), value)) {}
    HWY_INLINE explicit wide(float value) : wide(static_cast<double>(value)) {}
};
using wide_mask = hn::Mask<DoubleTag>;
TETRALUX_LANE_OPERATIONS(wide, wide_mask)

HWY_INLINE wide operator*(wide a, wide b) {
    return hn::Mul(a.v, b.v);
}
HWY_INLINE wide round(wide a) {
    return hn::Round(a.v);
}
HWY_INLINE wide clamp(wide a, wide low, wide high) {
    return hn::Min(hn::Max(a.v, low.v), high.v);
}
HWY_INLINE wide copySign(wide magnitude, wide sign) {
    return hn::CopySign(magnitude.v, sign.v);
}

#undef TETRALUX_LANE_OPERATIONS

}  // namespace tetralux::projection::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
