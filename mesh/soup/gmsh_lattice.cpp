// SPDX-License-Identifier: Apache-2.0
#include <mesh/soup/gmsh_lattice.h>

#include <cstddef>
#include <span>

namespace tetralux::mesh {
namespace {

using Points = std::vector<LatticePoint>;
struct Edge {
    std::size_t from, to;
};
using Face = std::vector<std::size_t>;

/// Edges, with their directions, and faces, with the corner and sense in which their insides are numbered.
struct Frame {
    Points corners;  ///< of order one
    std::vector<Edge> edges;
    std::vector<Face> faces;
};

const Frame& frameOf(Shape shape) {
    static const Frame tet{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                           {{0, 1}, {1, 2}, {2, 0}, {3, 0}, {3, 2}, {3, 1}},
                           {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {3, 1, 2}}};
    static const Frame hexahedron{
        {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}},
        {{0, 1}, {0, 3}, {0, 4}, {1, 2}, {1, 5}, {2, 3}, {2, 6}, {3, 7}, {4, 5}, {4, 7}, {5, 6}, {6, 7}},
        {{0, 3, 2, 1}, {0, 1, 5, 4}, {0, 4, 7, 3}, {1, 2, 6, 5}, {2, 3, 7, 6}, {4, 5, 6, 7}}};
    static const Frame wedge{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}},
                             {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 4}, {2, 5}, {3, 4}, {3, 5}, {4, 5}},
                             {{0, 2, 1}, {3, 4, 5}, {0, 1, 4, 3}, {0, 3, 5, 2}, {1, 2, 5, 4}}};
    static const Frame pyramid{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}},
                               {{0, 1}, {0, 3}, {0, 4}, {1, 2}, {1, 4}, {2, 3}, {2, 4}, {3, 4}},
                               {{0, 1, 4}, {3, 0, 4}, {1, 2, 4}, {2, 3, 4}, {0, 3, 2, 1}}};
    switch (shape) {
        case Shape::Hexahedron:
            return hexahedron;
        case Shape::Wedge:
            return wedge;
        case Shape::Pyramid:
            return pyramid;
        default:
            return tet;
    }
}

/// From `origin` i steps of (to − origin) / order.
LatticePoint along(const LatticePoint& origin, const LatticePoint& to, int steps, int order) {
    LatticePoint point = origin;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        point[axis] += (to[axis] - origin[axis]) * steps / order;
    }
    return point;
}

/// `corner` plus the steps, of which there are `order` along each side, that lead from it to `a`, `i` of them, and to
/// `b`, `j` of them.
LatticePoint within(const LatticePoint& corner, const LatticePoint& a, int i, const LatticePoint& b, int j, int order) {
    LatticePoint point = corner;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        point[axis] += ((a[axis] - corner[axis]) * i + (b[axis] - corner[axis]) * j) / order;
    }
    return point;
}

void addEdge(const LatticePoint& from, const LatticePoint& to, int order, Points& points) {
    for (int k = 1; k < order; ++k) {
        points.push_back(along(from, to, k, order));
    }
}

/// A whole triangle or quadrilateral.
void addFace(const std::vector<LatticePoint>& corners, int order, Points& points);

/// The inside of one.
void addInsideOfFace(const std::vector<LatticePoint>& v, int order, Points& points) {
    if (v.size() == 3 && order >= 3) {
        addFace({within(v[0], v[1], 1, v[2], 1, order), within(v[0], v[1], order - 2, v[2], 1, order),
                 within(v[0], v[1], 1, v[2], order - 2, order)},
                order - 3, points);
    } else if (v.size() == 4 && order >= 2) {
        const int last = order - 1;
        addFace({within(v[0], v[1], 1, v[3], 1, order), within(v[0], v[1], last, v[3], 1, order),
                 within(v[0], v[1], last, v[3], last, order), within(v[0], v[1], 1, v[3], last, order)},
                order - 2, points);
    }
}

void addFace(const std::vector<LatticePoint>& corners, int order, Points& points) {
    if (order == 0) {
        points.push_back(corners[0]);
        return;
    }
    points.insert(points.end(), corners.begin(), corners.end());
    for (std::size_t k = 0; k < corners.size(); ++k) {
        addEdge(corners[k], corners[(k + 1) % corners.size()], order, points);
    }
    addInsideOfFace(corners, order, points);
}

Points wholeElement(Shape shape, int order);

/// `inner` moved by one step along each axis, which is where the inside of an element begins.
void addMoved(const Points& inner, Points& points) {
    for (const LatticePoint& p : inner) {
        points.push_back({p[0] + 1, p[1] + 1, p[2] + 1});
    }
}

/// A wedge's inside is a line over each point of a triangle's.
void addInsideOfWedge(int order, Points& points) {
    Points triangle, line;
    addFace({{1, 1, 0}, {order - 2, 1, 0}, {1, order - 2, 0}}, order - 3, triangle);
    line.push_back({0, 0, 1});
    if (order > 2) {
        line.push_back({0, 0, order - 1});
        addEdge(line[0], line[1], order - 2, line);
    }
    for (const LatticePoint& p : triangle) {
        for (const LatticePoint& height : line) {
            points.push_back({p[0], p[1], height[2]});
        }
    }
}

void addInside(Shape shape, int order, Points& points) {
    if (shape == Shape::Tet && order >= 4) {
        addMoved(wholeElement(shape, order - 4), points);
    } else if (shape == Shape::Hexahedron && order >= 2) {
        addMoved(wholeElement(shape, order - 2), points);
    } else if (shape == Shape::Wedge && order >= 3) {
        addInsideOfWedge(order, points);
    } else if (shape == Shape::Pyramid && order >= 3) {
        addMoved(wholeElement(shape, order - 3), points);
    }
}

Points wholeElement(Shape shape, int order) {
    if (order == 0) {
        return {{0, 0, 0}};
    }
    const Frame& frame = frameOf(shape);
    Points points;
    for (const LatticePoint& corner : frame.corners) {
        points.push_back({order * corner[0], order * corner[1], order * corner[2]});
    }
    const Points corners = points;
    for (const Edge& edge : frame.edges) {
        addEdge(corners[edge.from], corners[edge.to], order, points);
    }
    for (const Face& face : frame.faces) {
        Points ends;
        for (const std::size_t corner : face) {
            ends.push_back(corners[corner]);
        }
        addInsideOfFace(ends, order, points);
    }
    addInside(shape, order, points);
    return points;
}

}  // namespace

std::vector<LatticePoint> gmshLattice(Shape shape, int order) {
    return wholeElement(shape, order);
}

int orderOfElement(Shape shape, std::size_t points) {
    constexpr std::size_t highestOrder = 10;
    for (std::size_t p = 1; p <= highestOrder; ++p) {
        const std::size_t triangle = (p + 1) * (p + 2) / 2;
        const std::size_t count = shape == Shape::Tet          ? triangle * (p + 3) / 3
                                  : shape == Shape::Hexahedron ? (p + 1) * (p + 1) * (p + 1)
                                  : shape == Shape::Wedge      ? triangle * (p + 1)
                                  : shape == Shape::Pyramid    ? triangle * (2 * p + 3) / 3
                                                               : 0;
        if (count == points) {
            return static_cast<int>(p);
        }
    }
    return 0;
}

}  // namespace tetralux::mesh
