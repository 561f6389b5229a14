// SPDX-License-Identifier: Apache-2.0
// The GLSL side of preint/glsl_prelude.h: the same names for the same things.
#define TETRALUX_GLSL_FUNCTION
#define TETRALUX_GLSL_INOUT(type) inout type
#define TETRALUX_GLSL_BOOL bool
#define real float

float select(bool condition, float ifTrue, float ifFalse) { return condition ? ifTrue : ifFalse; }
vec3 select(bool condition, vec3 ifTrue, vec3 ifFalse) { return condition ? ifTrue : ifFalse; }
bool exactlyOne(bool a, bool b) { return a != b; }
int select(bool condition, int ifTrue, int ifFalse) { return condition ? ifTrue : ifFalse; }
