// SPDX-License-Identifier: Apache-2.0
#include <mesh/soup/pyramid_basis.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include <mesh/soup/gmsh_lattice.h>

namespace tetralux::mesh {
namespace {

/// Jacobi's polynomial of degree n with parameters (a, 0) by its three-term recurrence (Abramowitz, Stegun 22.7.1).
double jacobi(int n, double a, double x) {
    double before = 1.0;
    double value = 0.5 * (a + (a + 2.0) * x);
    if (n == 0) {
        return before;
    }
    for (int k = 1; k < n; ++k) {
        const double s = 2.0 * k + a;
        const double first = 2.0 * (k + 1.0) * (k + a + 1.0) * s;
        const double next =
            ((s + 1.0) * (a * a + s * (s + 2.0) * x) * value - 2.0 * (k + a) * k * (s + 2.0) * before) / first;
        before = std::exchange(value, next);
    }
    return value;
}

/// The basis at a place; a sum over the values of points is to be found for each (Bergot et al., Proposition 1.8).
std::vector<double> basisAt(int order, const std::array<double, 3>& place) {
    const auto [r, s, t] = place;
    std::vector<double> values;
    for (int i = 0; i <= order; ++i) {
        for (int j = 0; j <= order; ++j) {
            const int larger = std::max(i, j);
            for (int k = 0; k <= order - larger; ++k) {
                values.push_back(jacobi(i, 0.0, 2.0 * r - 1.0) * jacobi(j, 0.0, 2.0 * s - 1.0) *
                                 std::pow(1.0 - t, larger) * jacobi(k, 2.0 * larger + 2.0, 2.0 * t - 1.0));
            }
        }
    }
    return values;
}

/// Solves matrix · x = columns by Gauss with row exchanges; `columns` become the solutions. All are stored by rows.
void solve(std::vector<std::vector<double>>& matrix, std::vector<std::vector<double>>& columns) {
    const std::size_t n = matrix.size();
    for (std::size_t step = 0; step < n; ++step) {
        std::size_t best = step;
        for (std::size_t row = step + 1; row < n; ++row) {
            best = std::abs(matrix[row][step]) > std::abs(matrix[best][step]) ? row : best;
        }
        std::swap(matrix[step], matrix[best]);
        std::swap(columns[step], columns[best]);
        for (std::size_t row = 0; row < n; ++row) {
            const double factor = row == step ? 0.0 : matrix[row][step] / matrix[step][step];
            if (factor == 0.0) {
                continue;
            }
            for (std::size_t k = step; k < n; ++k) {
                matrix[row][k] -= factor * matrix[step][k];
            }
            for (std::size_t k = 0; k < columns[row].size(); ++k) {
                columns[row][k] -= factor * columns[step][k];
            }
        }
    }
    for (std::size_t row = 0; row < n; ++row) {
        for (double& value : columns[row]) {
            value /= matrix[row][row];
        }
    }
}

}  // namespace

std::vector<std::vector<double>> pyramidShapeFunctions(int order, const std::vector<std::array<double, 3>>& places) {
    // Functions w with Σ w_n basis(point n) = basis(place): the matrix has a column for each point.
    const std::vector<LatticePoint> points = gmshLattice(Shape::Pyramid, order);
    std::vector<std::vector<double>> matrix(points.size(), std::vector<double>(points.size()));
    for (std::size_t n = 0; n < points.size(); ++n) {
        const double across = std::max(1, order - points[n][2]);
        const std::vector<double> basis =
            basisAt(order, {points[n][0] / across, points[n][1] / across, static_cast<double>(points[n][2]) / order});
        for (std::size_t k = 0; k < basis.size(); ++k) {
            matrix[k][n] = basis[k];
        }
    }
    std::vector<std::vector<double>> columns(points.size(), std::vector<double>(places.size()));
    for (std::size_t p = 0; p < places.size(); ++p) {
        const std::vector<double> basis = basisAt(order, places[p]);
        for (std::size_t k = 0; k < basis.size(); ++k) {
            columns[k][p] = basis[k];
        }
    }
    solve(matrix, columns);
    std::vector<std::vector<double>> weights(places.size(), std::vector<double>(points.size()));
    for (std::size_t p = 0; p < places.size(); ++p) {
        for (std::size_t n = 0; n < points.size(); ++n) {
            const double weight = columns[n][p];
            weights[p][n] = std::abs(weight) < 1e-13 ? 0.0 : weight;
        }
    }
    return weights;
}

}  // namespace tetralux::mesh
