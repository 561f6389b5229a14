// SPDX-License-Identifier: Apache-2.0
//
// The GLSL side of projection/cells/projected_cell.h: what the shared texts of projected cells call, in doubles.
// Their constants are definitions (gl_compute.cpp).
#define TETRALUX_CELL_FUNCTION
#define TETRALUX_CELL_IN(type) type
#define TETRALUX_CELL_INOUT(type) inout type
#define wide double
#define Pair dvec2
#define Triple dvec3

double select(bool condition, double ifTrue, double ifFalse) { return condition ? ifTrue : ifFalse; }
// zeros of either sign count as positive, as they do where faces are found to be front or back
double copySign(double magnitude, double other) { return other < 0.0lf ? -magnitude : magnitude; }
