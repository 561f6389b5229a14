// SPDX-License-Identifier: Apache-2.0
#include <mesh/soup/shape_functions.h>

#include <algorithm>
#include <cmath>

#include <mesh/soup/cell_types.h>
#include <mesh/soup/gmsh_lattice.h>
#include <mesh/soup/lagrange_points.h>
#include <mesh/soup/pyramid_basis.h>
#include <mesh/soup/quadratic_functions.h>

namespace tetralux::mesh {
namespace {

using Place = std::array<double, 3>;

constexpr std::size_t highestOrder = 10;

std::size_t pointsOfOrder(Shape shape, std::size_t p) {
    switch (shape) {
        case Shape::Tet:
            return (p + 1) * (p + 2) * (p + 3) / 6;
        case Shape::Hexahedron:
            return (p + 1) * (p + 1) * (p + 1);
        case Shape::Wedge:
            return (p + 1) * (p + 1) * (p + 2) / 2;
        default:
            return 0;  // no numbering for a pyramid of arbitrary order is agreed on
    }
}

/// The parametric cells are products of simplices: a tetrahedron, a triangle and a line, three lines. The barycentric
/// coordinates of all of them, of a place or of a lattice point in steps of 1/order; `one` is 1 or the order.
template <class Number>
std::vector<Number> barycentrics(Shape shape, const std::array<Number, 3>& at, Number one) {
    const auto [r, s, t] = at;
    switch (shape) {
        case Shape::Tet:
            return {one - r - s - t, r, s, t};
        case Shape::Wedge:
            return {one - r - s, r, s, one - t, t};
        default:
            return {one - r, r, one - s, s, one - t, t};
    }
}

int simplices(Shape shape) {
    return shape == Shape::Tet ? 1 : shape == Shape::Wedge ? 2 : 3;
}

/// Factors of Lagrange's functions: for each i the polynomial of degree i in `l` that is 1 at i/order and 0 at the
/// steps of 1/order below (P. Silvester: High-order polynomial triangular finite elements for potential problems,
/// 1969).
std::vector<double> lagrangeFactors(double l, int order) {
    std::vector<double> factors{1.0};
    for (int i = 0; i < order; ++i) {
        factors.push_back(factors.back() * (order * l - i) / (i + 1));
    }
    return factors;
}

/// Factors of Bernstein's polynomials: lⁱ/i!. Their product over a simplex takes `order`! to be one.
std::vector<double> bernsteinFactors(double l, int order) {
    std::vector<double> factors{1.0};
    for (int i = 0; i < order; ++i) {
        factors.push_back(factors.back() * l / (i + 1));
    }
    return factors;
}

/// Values at one place of the functions of the points with barycentric steps `points`.
std::vector<double> productsAt(const std::vector<double>& place, const std::vector<std::vector<int>>& points, int order,
                               bool bezier, double scale) {
    std::vector<std::vector<double>> factors;
    for (const double l : place) {
        factors.push_back(bezier ? bernsteinFactors(l, order) : lagrangeFactors(l, order));
    }
    std::vector<double> values;
    for (const std::vector<int>& point : points) {
        double product = scale;
        for (std::size_t k = 0; k < point.size(); ++k) {
            product *= factors[k][static_cast<std::size_t>(point[k])];
        }
        values.push_back(product);
    }
    return values;
}

bool isBezier(std::uint8_t type) {
    return type == cell_type::bezierTetrahedron || type == cell_type::bezierHexahedron ||
           type == cell_type::bezierWedge;
}

}  // namespace

std::optional<int> curvedCellOrder(std::uint8_t type, std::size_t pointCount) {
    const CellTypeInfo info = cellTypeInfo(type);
    if (info.linear || info.shape == Shape::None) {
        return std::nullopt;
    }
    if (quadraticCell(type, pointCount) != nullptr) {
        return 2;
    }
    if (info.pointCount != 0) {
        return pointCount == static_cast<std::size_t>(info.pointCount) ? std::optional<int>(2) : std::nullopt;
    }
    if (type == cell_type::gmshPyramid) {
        const int order = orderOfElement(Shape::Pyramid, pointCount);
        return order > 0 ? std::optional(order) : std::nullopt;
    }
    for (std::size_t p = 1; p <= highestOrder; ++p) {
        if (pointsOfOrder(info.shape, p) == pointCount) {
            return static_cast<int>(p);
        }
    }
    return std::nullopt;
}

std::vector<std::array<double, 3>> curvedCellPoints(std::uint8_t type, std::size_t pointCount) {
    if (const QuadraticCell* const own = quadraticCell(type, pointCount)) {
        return own->points();
    }
    const double order = curvedCellOrder(type, pointCount).value();
    std::vector<Place> points;
    if (type == cell_type::gmshPyramid) {
        for (const auto& [i, j, k] : gmshLattice(Shape::Pyramid, static_cast<int>(order))) {
            const double across = std::max(1.0, order - k);
            points.push_back({i / across, j / across, k / order});
        }
        return points;
    }
    for (const auto& [i, j, k] : lagrangePoints(cellTypeInfo(type).shape, static_cast<int>(order))) {
        points.push_back({i / order, j / order, k / order});
    }
    return points;
}

std::vector<std::vector<double>> shapeFunctions(std::uint8_t type, std::size_t pointCount,
                                                const std::vector<std::array<double, 3>>& places) {
    if (type == cell_type::gmshPyramid) {
        return pyramidShapeFunctions(orderOfElement(Shape::Pyramid, pointCount), places);
    }
    std::vector<std::vector<double>> weights;
    if (const QuadraticCell* const own = quadraticCell(type, pointCount)) {
        for (const Place& place : places) {
            weights.push_back(own->functions(place));
        }
        return weights;
    }
    const Shape shape = cellTypeInfo(type).shape;
    const int order = curvedCellOrder(type, pointCount).value();
    std::vector<std::vector<int>> points;
    for (const LatticePlace& point : lagrangePoints(shape, order)) {
        points.push_back(barycentrics(shape, point, order));
    }
    const bool bezier = isBezier(type);
    const double scale = bezier ? std::pow(std::tgamma(order + 1), simplices(shape)) : 1.0;
    for (const Place& place : places) {
        weights.push_back(productsAt(barycentrics(shape, place, 1.0), points, order, bezier, scale));
    }
    return weights;
}

}  // namespace tetralux::mesh
