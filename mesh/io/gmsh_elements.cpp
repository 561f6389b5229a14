// SPDX-License-Identifier: Apache-2.0
/// \file
/// Gmsh reference manual, "Node ordering", against the pictures in VTK's cell headers, and for orders above two against
/// where VTK says that the points of its cells lie.
#include <mesh/io/gmsh_elements.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <vector>

#include <mesh/soup/cell_types.h>
#include <mesh/soup/gmsh_lattice.h>
#include <mesh/soup/shape_functions.h>

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

/// Gmsh's types of complete solids from order three on.
struct HighOrder {
    Shape shape;
    int order;
};
const std::map<int, HighOrder>& highOrders() {
    static const std::map<int, HighOrder> all = [] {
        struct Family {
            Shape shape;
            std::array<int, 8> types;  ///< of orders 3, 4, …
        };
        std::map<int, HighOrder> found;
        for (const Family& family : {Family{Shape::Tet, {29, 30, 31, 71, 72, 73, 74, 75}},
                                     Family{Shape::Hexahedron, {92, 93, 94, 95, 96, 97, 98, 0}},
                                     Family{Shape::Wedge, {90, 91, 106, 107, 108, 109, 110, 0}},
                                     Family{Shape::Pyramid, {118, 119, 120, 121, 122, 123, 124, 0}}}) {
            for (std::size_t i = 0; i < family.types.size(); ++i) {
                found[family.types[i]] = {family.shape, static_cast<int>(i) + 3};
            }
        }
        found.erase(0);
        return found;
    }();
    return all;
}

std::uint8_t lagrangeType(Shape shape) {
    using namespace cell_type;
    return shape == Shape::Tet          ? lagrangeTetrahedron
           : shape == Shape::Hexahedron ? lagrangeHexahedron
           : shape == Shape::Wedge      ? lagrangeWedge
                                        : gmshPyramid;
}

/// For each point of VTK's cell the place in Gmsh's list of the one that lies there.
std::vector<int> orderOfVtk(const HighOrder& element) {
    const std::vector<LatticePoint> points = gmshLattice(element.shape, element.order);
    std::vector<int> order(points.size());
    if (element.shape == Shape::Pyramid) {
        for (std::size_t i = 0; i < order.size(); ++i) {
            order[i] = static_cast<int>(i);
        }
        return order;
    }
    std::map<LatticePoint, int> numbers;
    for (std::size_t i = 0; i < points.size(); ++i) {
        numbers[points[i]] = static_cast<int>(i);
    }
    const auto places = curvedCellPoints(lagrangeType(element.shape), points.size());
    std::transform(places.begin(), places.end(), order.begin(), [&](const std::array<double, 3>& place) {
        LatticePoint point{};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            point[axis] = static_cast<int>(std::lround(place[axis] * element.order));
        }
        return numbers.at(point);
    });
    return order;
}

GmshElement highOrderElement(int gmshType) {
    const auto found = highOrders().find(gmshType);
    if (found == highOrders().end()) {
        return {};
    }
    thread_local std::map<int, std::vector<int>> orders;
    std::vector<int>& order = orders[gmshType];
    if (order.empty()) {
        order = orderOfVtk(found->second);
    }
    return {static_cast<int>(order.size()), lagrangeType(found->second.shape), order};
}

/// Lines and faces of orders that no solid of order two has: only their number of points matters.
GmshElement flatElement(int gmshType) {
    using namespace cell_type;
    static const std::map<int, GmshElement> all = [] {
        struct Row {
            std::uint8_t type;
            std::size_t corners;
            std::vector<std::array<int, 2>> pointsOf;  ///< of Gmsh's types
        };
        const std::vector<Row> rows{
            {line, 2, {{26, 4}, {27, 5}, {28, 6}, {62, 7}, {63, 8}, {64, 9}, {65, 10}, {66, 11}}},
            {triangle,
             3,
             {{20, 9},
              {21, 10},
              {22, 12},
              {23, 15},
              {24, 15},
              {25, 21},
              {42, 28},
              {43, 36},
              {44, 45},
              {45, 55},
              {46, 66},
              {52, 18},
              {53, 21},
              {54, 24},
              {55, 27},
              {56, 30}}},
            {quad,
             4,
             {{36, 16},
              {37, 25},
              {38, 36},
              {39, 12},
              {40, 16},
              {41, 20},
              {47, 49},
              {48, 64},
              {49, 81},
              {50, 100},
              {51, 121},
              {57, 24},
              {58, 28},
              {59, 32},
              {60, 36},
              {61, 40}}}};
        std::map<int, GmshElement> found;
        for (const Row& row : rows) {
            for (const auto& [type, points] : row.pointsOf) {
                found[type] = {points, row.type, first(row.corners)};
            }
        }
        return found;
    }();
    const auto found = all.find(gmshType);
    return found == all.end() ? GmshElement{} : found->second;
}

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
            return {14, gmshPyramid, first(14)};
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
        default: {
            const GmshElement flat = flatElement(gmshType);
            return flat.points > 0 ? flat : highOrderElement(gmshType);
        }
    }
}

}  // namespace tetralux::mesh
