// SPDX-License-Identifier: Apache-2.0
#include <mesh/soup/quadratic_functions.h>

#include <algorithm>
#include <span>

#include <mesh/soup/cell_types.h>
#include <mesh/soup/lagrange_points.h>

namespace tetralux::mesh {
namespace {

using Place = std::array<double, 3>;
using Functions = std::vector<double>;

// Parts: a line, a triangle, a quadrilateral, each in [0, 1].

Functions linearLine(double x) {
    return {1.0 - x, x};
}

/// Both ends, then the middle.
Functions quadraticLine(double x) {
    return {(1.0 - x) * (1.0 - 2.0 * x), x * (2.0 * x - 1.0), 4.0 * x * (1.0 - x)};
}

std::array<double, 3> barycentric(double r, double s) {
    return {1.0 - r - s, r, s};
}

/// Corners, then the middles of the edges 01, 12, 20.
Functions quadraticTriangle(double r, double s) {
    const std::array<double, 3> l = barycentric(r, s);
    Functions w;
    for (const double x : l) {
        w.push_back(x * (2.0 * x - 1.0));
    }
    for (std::size_t e = 0; e < 3; ++e) {
        w.push_back(4.0 * l[e] * l[(e + 1) % 3]);
    }
    return w;
}

/// `quadraticTriangle` and the centroid: 27 L₀L₁L₂, of which the others take what they are there, −1/9 and 4/9.
Functions centredTriangle(double r, double s) {
    Functions w = quadraticTriangle(r, s);
    const std::array<double, 3> l = barycentric(r, s);
    const double bubble = 27.0 * l[0] * l[1] * l[2];
    for (std::size_t k = 0; k < 6; ++k) {
        w[k] += bubble * (k < 3 ? 1.0 / 9.0 : -4.0 / 9.0);
    }
    w.push_back(bubble);
    return w;
}

/// The sides of a square or cube as −1 or 1, 0 for a middle: of point `p` along `axis`.
double side(const LatticePlace& p, std::size_t axis) {
    return p[axis] - 1.0;
}

/// Corners, then the middles of the edges 01, 12, 23, 30.
Functions serendipitySquare(double r, double s) {
    constexpr std::array<std::array<double, 2>, 8> points{
        {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}, {0, -1}, {1, 0}, {0, 1}, {-1, 0}}};
    const double x = 2.0 * r - 1.0, y = 2.0 * s - 1.0;
    Functions w;
    for (const auto& [px, py] : points) {
        if (px == 0.0) {
            w.push_back((1.0 - x * x) * (1.0 + py * y) / 2.0);
        } else if (py == 0.0) {
            w.push_back((1.0 - y * y) * (1.0 + px * x) / 2.0);
        } else {
            w.push_back((1.0 + px * x) * (1.0 + py * y) * (px * x + py * y - 1.0) / 4.0);
        }
    }
    return w;
}

/// Functions of a prism: those of its cross-section times those of a line. `numbers[level]` are the cell's points in
/// the sequence of the cross-section's.
template <std::size_t levels, std::size_t n>
Functions prism(const Functions& section, const Functions& line,
                const std::array<std::array<std::uint8_t, n>, levels>& numbers) {
    Functions w(levels * n);
    for (std::size_t level = 0; level < levels; ++level) {
        for (std::size_t k = 0; k < n; ++k) {
            w[numbers[level][k]] = section[k] * line[level];
        }
    }
    return w;
}

// Hexahedra.

Functions serendipityHexahedron(const Place& place) {
    const std::vector<LatticePlace> points = lagrangePoints(Shape::Hexahedron, 2);
    Functions w;
    for (std::size_t k = 0; k < 20; ++k) {
        double product = 1.0, sum = 0.0;
        bool corner = true;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const double x = 2.0 * place[axis] - 1.0, p = side(points[k], axis);
            product *= p == 0.0 ? 1.0 - x * x : 1.0 + p * x;
            sum += p * x;
            corner = corner && p != 0.0;
        }
        w.push_back(corner ? product * (sum - 2.0) / 8.0 : product / 4.0);
    }
    return w;
}

/// 24 points: a serendipity square times a quadratic line.
Functions squareByLine(const Place& place) {
    constexpr std::array<std::array<std::uint8_t, 8>, 3> numbers{
        {{0, 1, 2, 3, 8, 9, 10, 11}, {4, 5, 6, 7, 12, 13, 14, 15}, {16, 17, 18, 19, 22, 21, 23, 20}}};
    return prism(serendipitySquare(place[0], place[1]), quadraticLine(place[2]), numbers);
}

// Wedges.

Functions serendipityWedge(const Place& place) {
    const std::array<double, 3> l = barycentric(place[0], place[1]);
    const double z = 2.0 * place[2] - 1.0;
    Functions w;
    for (const double up : {1.0 - z, 1.0 + z}) {
        for (const double x : l) {
            w.push_back(0.5 * x * ((2.0 * x - 1.0) * up - (1.0 - z * z)));
        }
    }
    for (const double up : {1.0 - z, 1.0 + z}) {
        for (std::size_t e = 0; e < 3; ++e) {
            w.push_back(2.0 * l[e] * l[(e + 1) % 3] * up);
        }
    }
    for (const double x : l) {
        w.push_back(x * (1.0 - z * z));
    }
    return w;
}

/// 12 points: a quadratic triangle times a linear line.
Functions triangleByLinear(const Place& place) {
    constexpr std::array<std::array<std::uint8_t, 6>, 2> numbers{{{0, 1, 2, 6, 7, 8}, {3, 4, 5, 9, 10, 11}}};
    return prism(quadraticTriangle(place[0], place[1]), linearLine(place[2]), numbers);
}

/// 21 points: a triangle with its centroid times a quadratic line.
Functions centredWedge(const Place& place) {
    constexpr std::array<std::array<std::uint8_t, 7>, 3> numbers{
        {{0, 1, 2, 6, 7, 8, 15}, {3, 4, 5, 9, 10, 11, 16}, {12, 13, 14, 17, 18, 19, 20}}};
    return prism(centredTriangle(place[0], place[1]), quadraticLine(place[2]), numbers);
}

// Tetrahedra.

constexpr std::array<std::array<std::uint8_t, 2>, 6> tetrahedronEdges{{{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}}};
constexpr std::array<std::array<std::uint8_t, 3>, 4> tetrahedronFaces{{{0, 1, 2}, {0, 1, 3}, {1, 2, 3}, {0, 2, 3}}};

/// 15 points: the quadratic functions, 27 LᵢLⱼLₖ(1 − 4Lₗ) for the centroids of faces and 256 L₀L₁L₂L₃ for that of the
/// cell, of which the quadratic ones take what they are there.
Functions centredTetrahedron(const Place& place) {
    const auto [r, s, t] = place;
    const std::array<double, 4> l{1.0 - r - s - t, r, s, t};
    const double inner = 256.0 * l[0] * l[1] * l[2] * l[3];
    std::array<double, 4> faces{};
    for (std::size_t f = 0; f < 4; ++f) {
        const auto& [a, b, c] = tetrahedronFaces[f];
        faces[f] = 27.0 * l[a] * l[b] * l[c] - 27.0 / 64.0 * inner;
    }
    Functions w;
    const auto add = [&](double value, double inFaces, double inside, auto&& touches) {
        for (std::size_t f = 0; f < 4; ++f) {
            value -= touches(tetrahedronFaces[f]) ? inFaces * faces[f] : 0.0;
        }
        w.push_back(value - inside * inner);
    };
    const auto has = [](const std::array<std::uint8_t, 3>& face, std::size_t corner) {
        return std::find(face.begin(), face.end(), corner) != face.end();
    };
    for (std::size_t k = 0; k < 4; ++k) {
        add(l[k] * (2.0 * l[k] - 1.0), -1.0 / 9.0, -1.0 / 8.0, [&](const auto& face) { return has(face, k); });
    }
    for (const auto& [a, b] : tetrahedronEdges) {
        add(4.0 * l[a] * l[b], 4.0 / 9.0, 1.0 / 4.0,
            [&, a = a, b = b](const auto& face) { return has(face, a) && has(face, b); });
    }
    w.insert(w.end(), faces.begin(), faces.end());
    w.push_back(inner);
    return w;
}

// Pyramids: corners of the base, the apex, the middles of the base's edges 01, 12, 23, 30 and of those to the apex,
// then, of 19, the centres of the base, of the faces over these edges and of the cell. Here x and y are in [−1, 1].

constexpr std::array<std::array<double, 2>, 4> baseCorners{{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}};
constexpr std::array<std::array<double, 2>, 4> baseMiddles{{{0, -1}, {1, 0}, {0, 1}, {-1, 0}}};

struct PyramidPlace {
    double x, y, t;
    explicit PyramidPlace(const Place& place) : x(2.0 * place[0] - 1.0), y(2.0 * place[1] - 1.0), t(place[2]) {}
    /// 1 at a corner of the layer, 0 at the others.
    double bilinear(const std::array<double, 2>& corner) const {
        return (1.0 + corner[0] * x) * (1.0 + corner[1] * y) / 4.0;
    }
    /// 4t(1 − t) of it: the middle of the edge to the apex.
    double rising(const std::array<double, 2>& corner) const { return 4.0 * t * (1.0 - t) * bilinear(corner); }
    /// Of the side over the middle of a base's edge: how far along the normal, 1 at the side; and 1 − that along it².
    double towards(const std::array<double, 2>& middle) const { return middle[0] * x + middle[1] * y; }
    double along(const std::array<double, 2>& middle) const { return middle[0] == 0.0 ? 1.0 - x * x : 1.0 - y * y; }
};

/// 13 points: a serendipity hexahedron of which the upper face is one point, its base's edges corrected so that they
/// are those of a quadratic triangle on the sides (K.-J. Bathe: Finite Element Procedures, 1996, section 5.3.2).
Functions serendipityPyramid(const Place& place) {
    const PyramidPlace p(place);
    std::array<double, 4> base{}, rising{};
    for (std::size_t e = 0; e < 4; ++e) {
        const double near = p.towards(baseMiddles[e]);
        base[e] = p.along(baseMiddles[e]) * (1.0 + near) * (1.0 - p.t) * (1.0 - near * p.t) / 2.0;
        rising[e] = p.rising(baseCorners[e]);
    }
    Functions w;
    for (std::size_t c = 0; c < 4; ++c) {
        w.push_back(p.bilinear(baseCorners[c]) * (1.0 - p.t) - (base[c] + base[(c + 3) % 4] + rising[c]) / 2.0);
    }
    w.push_back(p.t * (2.0 * p.t - 1.0));
    w.insert(w.end(), base.begin(), base.end());
    w.insert(w.end(), rising.begin(), rising.end());
    return w;
}

/// 14 points: the polynomials on layers that shrink of M. Bergot, G. Cohen, M. Duruflé: Higher-order finite elements
/// for hybrid meshes using new nodal pyramidal elements, J. Sci. Comput. 42, 2010.
Functions completePyramid(const PyramidPlace& p) {
    const double layer = (1.0 - p.t) * (1.0 - p.t);
    Functions w;
    for (const std::array<double, 2>& c : baseCorners) {
        w.push_back(p.x * (p.x + c[0]) * p.y * (p.y + c[1]) * layer / 4.0 - p.rising(c) / 4.0);
    }
    w.push_back(p.t * (2.0 * p.t - 1.0));
    for (const std::array<double, 2>& m : baseMiddles) {
        const double near = p.towards(m);
        w.push_back(p.along(m) * near * (near + 1.0) * layer / 2.0);
    }
    for (const std::array<double, 2>& c : baseCorners) {
        w.push_back(p.rising(c));
    }
    w.push_back((1.0 - p.x * p.x) * (1.0 - p.y * p.y) * layer);
    return w;
}

/// 19 points: the complete pyramid with centroids of the four sides and of the cell, of which the others take what they
/// are there.
Functions centredPyramid(const Place& place) {
    const PyramidPlace p(place);
    std::array<double, 4> sides{};
    std::array<Functions, 4> atSides;
    Functions w = completePyramid(p);
    for (std::size_t f = 0; f < 4; ++f) {
        const std::array<double, 2>& m = baseMiddles[f];
        const double near = p.towards(m);
        sides[f] = 27.0 / 8.0 * p.t * (1.0 - p.t) * (1.0 - p.t) * near * (near + 1.0) * p.along(m);
        atSides[f] = completePyramid(PyramidPlace({(m[0] + 1.0) / 2.0, (m[1] + 1.0) / 2.0, 1.0 / 3.0}));
    }
    // The functions of the sides are 0 in the middle of each layer.
    const Functions atCentre = completePyramid(PyramidPlace({0.5, 0.5, 0.25}));
    const double inner = 16.0 / 3.0 * p.t * (1.0 - p.t) * (1.0 - p.x * p.x) * (1.0 - p.y * p.y);
    for (std::size_t k = 0; k < w.size(); ++k) {
        for (std::size_t f = 0; f < 4; ++f) {
            w[k] -= atSides[f][k] * sides[f];
        }
        w[k] -= atCentre[k] * inner;
    }
    w.insert(w.end(), sides.begin(), sides.end());
    w.push_back(inner);
    return w;
}

// Where the points lie.

template <Shape shape, std::size_t count>
std::vector<Place> firstOfLattice() {
    std::vector<Place> points;
    for (const auto& [i, j, k] : lagrangePoints(shape, 2)) {
        if (points.size() < count) {
            points.push_back({i / 2.0, j / 2.0, k / 2.0});
        }
    }
    return points;
}

std::vector<Place> centredWedgePoints() {
    constexpr double third = 1.0 / 3.0;
    std::vector<Place> points = firstOfLattice<Shape::Wedge, 15>();
    const std::vector<Place> sides{{0.5, 0, 0.5}, {0.5, 0.5, 0.5}, {0, 0.5, 0.5}};
    points.insert(points.end(), {{third, third, 0}, {third, third, 1}});
    points.insert(points.end(), sides.begin(), sides.end());
    points.push_back({third, third, 0.5});
    return points;
}

std::vector<Place> centredTetrahedronPoints() {
    constexpr double third = 1.0 / 3.0;
    std::vector<Place> points = firstOfLattice<Shape::Tet, 10>();
    points.insert(points.end(), {{third, third, 0}, {third, 0, third}, {third, third, third}, {0, third, third}});
    points.push_back({0.25, 0.25, 0.25});
    return points;
}

template <std::size_t count>
std::vector<Place> pyramidPoints() {
    std::vector<Place> points;
    const auto add = [&](std::span<const std::array<double, 2>> places, double t) {
        for (const auto& [x, y] : places) {
            points.push_back({(x + 1.0) / 2.0, (y + 1.0) / 2.0, t});
        }
    };
    constexpr std::array<std::array<double, 2>, 1> centre{{{0, 0}}};
    add(baseCorners, 0.0);
    add(centre, 1.0);
    add(baseMiddles, 0.0);
    add(baseCorners, 0.5);
    add(centre, 0.0);
    add(baseMiddles, 1.0 / 3.0);
    add(centre, 0.25);
    points.resize(count);
    return points;
}

using namespace cell_type;

constexpr std::array<QuadraticCell, 8> quadraticCells{{
    {quadraticHexahedron, 20, serendipityHexahedron, firstOfLattice<Shape::Hexahedron, 20>},
    {biquadraticQuadraticHexahedron, 24, squareByLine, firstOfLattice<Shape::Hexahedron, 24>},
    {quadraticWedge, 15, serendipityWedge, firstOfLattice<Shape::Wedge, 15>},
    {quadraticLinearWedge, 12, triangleByLinear, firstOfLattice<Shape::Wedge, 12>},
    {quadraticPyramid, 13, serendipityPyramid, pyramidPoints<13>},
    {triquadraticPyramid, 19, centredPyramid, pyramidPoints<19>},
    {lagrangeTetrahedron, 15, centredTetrahedron, centredTetrahedronPoints},
    {lagrangeWedge, 21, centredWedge, centredWedgePoints},
}};

}  // namespace

const QuadraticCell* quadraticCell(std::uint8_t type, std::size_t pointCount) {
    const auto found = std::find_if(quadraticCells.begin(), quadraticCells.end(), [&](const QuadraticCell& cell) {
        return cell.type == type && cell.pointCount == pointCount;
    });
    return found != quadraticCells.end() ? &*found : nullptr;
}

}  // namespace tetralux::mesh
