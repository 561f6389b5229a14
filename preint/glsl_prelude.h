// SPDX-License-Identifier: Apache-2.0
/// \file
/// What a `.glsl` text of ours needs to compile as C++ in double precision. Include it, open a namespace,
/// `#include` the text. In GLSL the same names come from preint/glsl_prelude.glsl.
///
/// The texts keep to a common subset: `real`, `vec2/3/4`, no swizzle but .x .y .z .w, literals through `real(…)`,
/// `select(condition, ifTrue, ifFalse)` where both sides are cheap.
#pragma once

#include <cmath>

#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#define TETRALUX_GLSL_FUNCTION inline
#define TETRALUX_GLSL_INOUT(type) type&
#define TETRALUX_GLSL_BOOL bool

namespace tetralux::glsl {

using real = double;
using vec2 = glm::dvec2;
using vec3 = glm::dvec3;
using vec4 = glm::dvec4;
using glm::abs;
using glm::clamp;
using glm::dot;
using glm::exp;
using glm::floor;
using glm::log;
using glm::max;
using glm::min;
using glm::mix;
using glm::normalize;
using glm::pow;
using glm::sqrt;

template <class T>
T select(bool condition, const T& ifTrue, const T& ifFalse) {
    return condition ? ifTrue : ifFalse;
}

inline bool exactlyOne(bool a, bool b) {
    return a != b;
}

}  // namespace tetralux::glsl
