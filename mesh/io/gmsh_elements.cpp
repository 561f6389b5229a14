// SPDX-License-Identifier: Apache-2.0
/// \file
/// Gmsh reference manual, "Node ordering", against the pictures in VTK's cell headers.
#include <mesh/io/gmsh_elements.h>

#include <array>

#include <mesh/soup/cell_types.h>

namespace tetralux::mesh {
namespace {

template <int n>
constexpr std::array<int, n> inOrder() {
    std::array<int, n> order{};
    for (int i = 0; i < n; ++i) {
        order[static_cast<std::size_t>(i)] = i;
    }
    return order;
}

constexpr auto same = inOrder<27>();
constexpr std::span<const int> first(std::size_t count) {
    return std::span<const int>(same).first(count);
}

constexpr std::array tet10{0, 1, 2, 3, 4, 5, 6, 7, 9, 8};
constexpr std::array hex20{0, 1, 2, 3, 4, 5, 6, 7, 8, 11, 13, 9, 16, 18, 19, 17, 10, 12, 14, 15};
constexpr std::array hex27{0,  1,  2,  3,  4,  5,  6,  7,  8,  11, 13, 9,  16, 18,
                           19, 17, 10, 12, 14, 15, 22, 23, 21, 24, 20, 25, 26};
constexpr std::array wedge15{0, 1, 2, 3, 4, 5, 6, 9, 7, 12, 14, 13, 8, 10, 11};
constexpr std::array wedge18{0, 1, 2, 3, 4, 5, 6, 9, 7, 12, 14, 13, 8, 10, 11, 15, 17, 16};
constexpr std::array pyramid13{0, 1, 2, 3, 4, 5, 8, 10, 6, 7, 9, 11, 12};

}  // namespace

GmshElement gmshElement(int gmshType) {
    using namespace cell_type;
    switch (gmshType) {
        case 1:
            return {2, line, first(2)};
        case 2:
            return {3, triangle, first(3)};
        case 3:
            return {4, quad, first(4)};
        case 4:
            return {4, tetrahedron, first(4)};
        case 5:
            return {8, hexahedron, first(8)};
        case 6:
            return {6, wedge, first(6)};
        case 7:
            return {5, pyramid, first(5)};
        case 8:
            return {3, line, first(2)};
        case 9:
            return {6, triangle, first(3)};
        case 10:
            return {9, quad, first(4)};
        case 11:
            return {10, quadraticTetrahedron, tet10};
        case 12:
            return {27, triquadraticHexahedron, hex27};
        case 13:
            return {18, biquadraticQuadraticWedge, wedge18};
        case 14:
            return {14, quadraticPyramid, pyramid13};
        case 15:
            return {1, vertex, first(1)};
        case 16:
            return {8, quad, first(4)};
        case 17:
            return {20, quadraticHexahedron, hex20};
        case 18:
            return {15, quadraticWedge, wedge15};
        case 19:
            return {13, quadraticPyramid, pyramid13};
        case 20:
            return {9, triangle, first(3)};
        case 21:
            return {10, triangle, first(3)};
        case 22:
            return {12, triangle, first(3)};
        case 23:
        case 24:
            return {15, triangle, first(3)};
        case 25:
            return {21, triangle, first(3)};
        case 26:
            return {4, line, first(2)};
        case 27:
            return {5, line, first(2)};
        case 28:
            return {6, line, first(2)};
        case 29:
            return {20, tetrahedron, first(4)};
        case 30:
            return {35, tetrahedron, first(4)};
        case 31:
            return {56, tetrahedron, first(4)};
        case 36:
            return {16, quad, first(4)};
        case 37:
            return {25, quad, first(4)};
        case 90:
            return {40, wedge, first(6)};
        case 91:
            return {75, wedge, first(6)};
        case 92:
            return {64, hexahedron, first(8)};
        case 93:
            return {125, hexahedron, first(8)};
        default:
            return {};
    }
}

}  // namespace tetralux::mesh
