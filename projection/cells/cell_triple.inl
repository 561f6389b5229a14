// SPDX-License-Identifier: Apache-2.0
//
// What projected_cell.glsl needs in C++ and GLSL has: vectors of three `wide`. Included before it, in the same
// namespace; no guard, since it is once for doubles and once per instruction set.

struct Triple {
    wide x, y, z;
    Triple() = default;
    TETRALUX_CELL_FUNCTION Triple(const wide& a, const wide& b, const wide& c) : x(a), y(b), z(c) {}
};
TETRALUX_CELL_FUNCTION Triple operator+(const Triple& a, const Triple& b) {
    return Triple(a.x + b.x, a.y + b.y, a.z + b.z);
}
TETRALUX_CELL_FUNCTION Triple operator-(const Triple& a, const Triple& b) {
    return Triple(a.x - b.x, a.y - b.y, a.z - b.z);
}
TETRALUX_CELL_FUNCTION Triple operator*(const wide& a, const Triple& b) {
    return Triple(a * b.x, a * b.y, a * b.z);
}
TETRALUX_CELL_FUNCTION Triple cross(const Triple& a, const Triple& b) {
    return Triple(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}
TETRALUX_CELL_FUNCTION wide dot(const Triple& a, const Triple& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
