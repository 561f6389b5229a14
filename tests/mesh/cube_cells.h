// SPDX-License-Identifier: Apache-2.0
/// \file
/// Cells of every type that fill a cube, for `cubeGrid`.
#pragma once

#include <array>
#include <cmath>
#include <map>
#include <vector>

#include <mesh/soup/reference_lattice.h>
#include <mesh/soup/shape_functions.h>

#include "mesh_checks.h"

namespace tetralux::mesh::test {

using Cube = std::array<std::uint32_t, 8>;  // corner of the bits zyx
using Ids = std::vector<std::uint32_t>;

inline Ids hexahedronOf(const Cube& c) {
    return {c[0], c[1], c[3], c[2], c[4], c[5], c[7], c[6]};
}

inline void addHexahedron(CellSoup& soup, const Cube& c) {
    appendCell(soup, cell_type::hexahedron, hexahedronOf(c));
}
inline void addVoxel(CellSoup& soup, const Cube& c) {
    appendCell(soup, cell_type::voxel, c);
}

inline void addWedges(CellSoup& soup, const Cube& c) {
    appendCell(soup, cell_type::wedge, Ids{c[0], c[1], c[3], c[4], c[5], c[7]});
    appendCell(soup, cell_type::wedge, Ids{c[0], c[3], c[2], c[4], c[7], c[6]});
}

/// Six pyramids about the middle of the cube.
inline void addPyramids(CellSoup& soup, const Cube& c) {
    glm::dvec3 middle(0.0);
    for (const std::uint32_t p : c) {
        middle += soup.points[p] / 8.0;
    }
    const std::uint32_t tip = static_cast<std::uint32_t>(soup.points.size());
    soup.points.push_back(middle);
    const Ids h = hexahedronOf(c);
    for (const std::array<std::size_t, 4>& f : {std::array<std::size_t, 4>{0, 1, 2, 3},
                                                {4, 7, 6, 5},
                                                {0, 4, 5, 1},
                                                {1, 5, 6, 2},
                                                {2, 6, 7, 3},
                                                {3, 7, 4, 0}}) {
        appendCell(soup, cell_type::pyramid, Ids{h[f[0]], h[f[1]], h[f[2]], h[f[3]], tip});
    }
}

/// The cube as a polyhedron; every other face is listed inwards.
inline void addPolyhedron(CellSoup& soup, const Cube& c) {
    const Ids h = hexahedronOf(c);
    if (soup.faceOffsets.empty()) {
        soup.faceOffsets.push_back(0);
    }
    appendCell(soup, cell_type::polyhedron, h);
    for (const std::array<std::size_t, 4>& f : {std::array<std::size_t, 4>{0, 3, 2, 1},
                                                {4, 7, 6, 5},
                                                {0, 1, 5, 4},
                                                {1, 5, 6, 2},
                                                {2, 3, 7, 6},
                                                {3, 7, 4, 0}}) {
        for (const std::uint32_t entry : {4u, h[f[0]], h[f[1]], h[f[2]], h[f[3]]}) {
            soup.faceStream.push_back(entry);
        }
    }
    soup.faceOffsets.push_back(soup.faceStream.size());
}

/// The six tetrahedra about one diagonal, the same in every cube.
inline void addTetrahedra(CellSoup& soup, const Cube& c) {
    for (const Ids& t : {Ids{c[0], c[1], c[3], c[7]}, Ids{c[0], c[3], c[2], c[7]}, Ids{c[0], c[2], c[6], c[7]},
                         Ids{c[0], c[6], c[4], c[7]}, Ids{c[0], c[4], c[5], c[7]}, Ids{c[0], c[5], c[1], c[7]}}) {
        appendCell(soup, cell_type::tetrahedron, t);
    }
}

/// Hexahedra in some cubes, tetrahedra in others, so that quadrilaterals lie against pairs of triangles.
inline void addMixed(CellSoup& soup, const Cube& c) {
    if (soup.types.size() % 7 < 3) {
        addHexahedron(soup, c);
    } else {
        addTetrahedra(soup, c);
    }
}

struct CellKind {
    const char* name;
    void (*add)(CellSoup&, const Cube&);
};

inline constexpr std::array linearCellKinds{CellKind{"hexahedron", addHexahedron}, CellKind{"voxel", addVoxel},
                                            CellKind{"wedge", addWedges},          CellKind{"pyramid", addPyramids},
                                            CellKind{"polyhedron", addPolyhedron}, CellKind{"mixed", addMixed}};

/// Where the points of a curved cell lie: for each the weights of the corners of its linear cell.
struct CurvedNodes {
    std::vector<std::array<double, 3>> places;  ///< parametric
    std::vector<std::vector<double>> cornerWeights;
};

inline CurvedNodes curvedNodes(std::uint8_t type, std::size_t points) {
    CurvedNodes nodes{curvedCellPoints(type, points), {}};
    for (const std::array<double, 3>& place : nodes.places) {
        nodes.cornerWeights.push_back(cornerWeights(cellTypeInfo(type).shape, place));
    }
    return nodes;
}

struct CurvedKind {
    const char* name;
    std::uint8_t type;
    std::size_t points;
    void (*addLinear)(CellSoup&, const Cube&);  ///< the linear cells that it stands in for
};

/// n³ cubes of curved cells over the unit cube: the linear ones with points between their corners, shared between
/// neighbours, and all of them moved by `warp`.
inline CellSoup curvedGrid(int n, const CurvedKind& kind, const std::function<glm::dvec3(const glm::dvec3&)>& warp) {
    const CellSoup linear = cubeGrid(n, 5, straight, kind.addLinear);
    const CurvedNodes nodes = curvedNodes(kind.type, kind.points);
    CellSoup soup;
    std::map<std::array<long, 3>, std::uint32_t> known;
    for (std::size_t cell = 0; cell < linear.types.size(); ++cell) {
        Ids ids;
        for (const std::vector<double>& weights : nodes.cornerWeights) {
            glm::dvec3 x(0.0);
            for (std::size_t k = 0; k < weights.size(); ++k) {
                x += weights[k] * linear.points[linear.connectivity[linear.offsets[cell] + k]];
            }
            const std::array<long, 3> key{std::lround(x.x * 1e9), std::lround(x.y * 1e9), std::lround(x.z * 1e9)};
            const auto [at, isNew] = known.emplace(key, static_cast<std::uint32_t>(soup.points.size()));
            if (isNew) {
                soup.points.push_back(warp(x));
            }
            ids.push_back(at->second);
        }
        appendCell(soup, kind.type, ids);
    }
    return soup;
}

inline constexpr std::array curvedCellKinds{
    CurvedKind{"tet10", cell_type::quadraticTetrahedron, 10, addTetrahedra},
    CurvedKind{"hex20", cell_type::quadraticHexahedron, 20, addHexahedron},
    CurvedKind{"hex27", cell_type::triquadraticHexahedron, 27, addHexahedron},
    CurvedKind{"wedge15", cell_type::quadraticWedge, 15, addWedges},
    CurvedKind{"pyramid13", cell_type::quadraticPyramid, 13, addPyramids},
    CurvedKind{"pyramid19", cell_type::triquadraticPyramid, 19, addPyramids},
    CurvedKind{"tet15", cell_type::lagrangeTetrahedron, 15, addTetrahedra},
    CurvedKind{"wedge21", cell_type::lagrangeWedge, 21, addWedges},
    CurvedKind{"lagrange_tet20", cell_type::lagrangeTetrahedron, 20, addTetrahedra},
    CurvedKind{"lagrange_hex64", cell_type::lagrangeHexahedron, 64, addHexahedron},
    CurvedKind{"lagrange_wedge40", cell_type::lagrangeWedge, 40, addWedges}};

}  // namespace tetralux::mesh::test
