// SPDX-License-Identifier: Apache-2.0
/// \file
/// vec3 and the functions that the shading texts call, in SIMD lanes. Included once per instruction set.
#include <projection/cpu/cpu_segment.h>

#if defined(TETRALUX_CPU_SHADING_VECTORS_H) == defined(HWY_TARGET_TOGGLE)
#ifdef TETRALUX_CPU_SHADING_VECTORS_H
#undef TETRALUX_CPU_SHADING_VECTORS_H
#else
#define TETRALUX_CPU_SHADING_VECTORS_H
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
HWY_INLINE real log(real a) {
    return hn::Log(FloatTag(), a.v);
}
/// For a ≥ 0.
HWY_INLINE real pow(real a, real exponent) {
    return exp(exponent * log(max(a, real(1e-30f))));
}

#undef TETRALUX_GLSL_INOUT
#define TETRALUX_GLSL_INOUT(type) type&

}  // namespace tetralux::projection::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
