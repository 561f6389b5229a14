// SPDX-License-Identifier: Apache-2.0
#include <mesh/soup/lagrange_points.h>

#include <cstddef>

namespace tetralux::mesh {
namespace {

/// Collects the points of a tetrahedron: shell by shell, each numbered as the whole is.
class TetrahedronPoints {
public:
    explicit TetrahedronPoints(int order) : order_(order) {
        for (int shell = 0; 4 * shell <= order; ++shell) {
            addShell(shell);
        }
    }

    std::vector<LatticePlace> take() { return std::move(points_); }

private:
    using Barycentric = std::array<int, 4>;

    void add(const Barycentric& b) { points_.push_back({b[1], b[2], b[3]}); }

    /// Points from corner `a` to corner `b` of a shell, between its corners; all barycentrics of `least` but these two
    /// stay as they are.
    void addEdge(Barycentric least, std::size_t a, std::size_t b, int length) {
        for (int step = 1; step < length; ++step) {
            Barycentric point = least;
            point[a] += length - step;
            point[b] += step;
            add(point);
        }
    }

    void addCorner(Barycentric least, std::size_t corner, int length) {
        least[corner] += length;
        add(least);
    }

    /// A triangle with all its points, corners first; `least` are the smallest barycentrics in it.
    void addTriangle(Barycentric least, const std::array<std::size_t, 3>& corners, int length) {
        if (length == 0) {
            add(least);
        }
        if (length <= 0) {
            return;
        }
        for (const std::size_t corner : corners) {
            addCorner(least, corner, length);
        }
        for (std::size_t e = 0; e < 3; ++e) {
            addEdge(least, corners[e], corners[(e + 1) % 3], length);
        }
        for (const std::size_t corner : corners) {
            ++least[corner];
        }
        addTriangle(least, corners, length - 3);
    }

    void addShell(int depth) {
        const Barycentric least{depth, depth, depth, depth};
        const int length = order_ - 4 * depth;
        if (length == 0) {
            add(least);
            return;
        }
        for (std::size_t corner = 0; corner < 4; ++corner) {
            addCorner(least, corner, length);
        }
        constexpr std::array<std::array<std::size_t, 2>, 6> edges{{{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}}};
        for (const auto& [a, b] : edges) {
            addEdge(least, a, b, length);
        }
        constexpr std::array<std::array<std::size_t, 3>, 4> faces{{{0, 1, 3}, {2, 3, 1}, {0, 3, 2}, {0, 2, 1}}};
        for (const std::array<std::size_t, 3>& face : faces) {
            Barycentric inside = least;
            for (const std::size_t corner : face) {
                ++inside[corner];
            }
            addTriangle(inside, face, length - 3);
        }
    }

    int order_;
    std::vector<LatticePlace> points_;
};

std::vector<LatticePlace> hexahedronPoints(int n) {
    std::vector<LatticePlace> points;
    constexpr std::array<std::array<int, 2>, 4> corners{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
    for (const int k : {0, n}) {
        for (const auto& [i, j] : corners) {
            points.push_back({i * n, j * n, k});
        }
    }
    for (const int k : {0, n}) {
        for (const auto& [along, across] : {std::array{0, 0}, {1, n}, {0, n}, {1, 0}}) {
            for (int step = 1; step < n; ++step) {
                points.push_back(along == 0 ? LatticePlace{step, across, k} : LatticePlace{across, step, k});
            }
        }
    }
    for (const auto& [i, j] : corners) {
        for (int k = 1; k < n; ++k) {
            points.push_back({i * n, j * n, k});
        }
    }
    for (std::size_t normal = 0; normal < 3; ++normal) {
        const std::size_t first = normal == 0 ? 1 : 0, second = normal == 2 ? 1 : 2;
        for (const int level : {0, n}) {
            for (int b = 1; b < n; ++b) {
                for (int a = 1; a < n; ++a) {
                    LatticePlace place{};
                    place[normal] = level;
                    place[first] = a;
                    place[second] = b;
                    points.push_back(place);
                }
            }
        }
    }
    for (int k = 1; k < n; ++k) {
        for (int j = 1; j < n; ++j) {
            for (int i = 1; i < n; ++i) {
                points.push_back({i, j, k});
            }
        }
    }
    return points;
}

std::vector<LatticePlace> wedgePoints(int n) {
    std::vector<LatticePlace> points;
    constexpr std::array<std::array<int, 2>, 3> corners{{{0, 0}, {1, 0}, {0, 1}}};
    const auto onEdge = [&](std::size_t edge, int step, int k) {
        const auto& a = corners[edge];
        const auto& b = corners[(edge + 1) % 3];
        points.push_back({a[0] * (n - step) + b[0] * step, a[1] * (n - step) + b[1] * step, k});
    };
    const auto withinTriangle = [&](int k) {
        for (int j = 1; j < n; ++j) {
            for (int i = 1; i + j < n; ++i) {
                points.push_back({i, j, k});
            }
        }
    };
    for (const int k : {0, n}) {
        for (std::size_t corner = 0; corner < 3; ++corner) {
            onEdge(corner, 0, k);
        }
    }
    for (const int k : {0, n}) {
        for (std::size_t edge = 0; edge < 3; ++edge) {
            for (int step = 1; step < n; ++step) {
                onEdge(edge, step, k);
            }
        }
    }
    for (std::size_t corner = 0; corner < 3; ++corner) {
        for (int k = 1; k < n; ++k) {
            onEdge(corner, 0, k);
        }
    }
    for (const int k : {0, n}) {
        withinTriangle(k);
    }
    for (std::size_t edge = 0; edge < 3; ++edge) {
        for (int k = 1; k < n; ++k) {
            for (int step = 1; step < n; ++step) {
                onEdge(edge, step, k);
            }
        }
    }
    for (int k = 1; k < n; ++k) {
        withinTriangle(k);
    }
    return points;
}

}  // namespace

std::vector<LatticePlace> lagrangePoints(Shape shape, int order) {
    switch (shape) {
        case Shape::Tet:
            return TetrahedronPoints(order).take();
        case Shape::Hexahedron:
            return hexahedronPoints(order);
        case Shape::Wedge:
            return wedgePoints(order);
        default:
            return {};
    }
}

}  // namespace tetralux::mesh
