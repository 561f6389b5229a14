// SPDX-License-Identifier: Apache-2.0
/// \file
/// The cell types of VTK's file formats, by their numbers, and the faces of the linear solids.
#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace tetralux::mesh {

namespace cell_type {
inline constexpr std::uint8_t vertex = 1, line = 3, triangle = 5, quad = 9;
inline constexpr std::uint8_t tetrahedron = 10, voxel = 11, hexahedron = 12, wedge = 13, pyramid = 14;
inline constexpr std::uint8_t pentagonalPrism = 15, hexagonalPrism = 16, polyhedron = 42;
inline constexpr std::uint8_t quadraticTetrahedron = 24, quadraticHexahedron = 25, quadraticWedge = 26;
inline constexpr std::uint8_t quadraticPyramid = 27, triquadraticHexahedron = 29, quadraticLinearWedge = 31;
inline constexpr std::uint8_t biquadraticQuadraticWedge = 32, biquadraticQuadraticHexahedron = 33;
inline constexpr std::uint8_t triquadraticPyramid = 37;
inline constexpr std::uint8_t lagrangeTetrahedron = 71, lagrangeHexahedron = 72, lagrangeWedge = 73,
                              lagrangePyramid = 74;
/// No type of VTK's, which has no pyramids of any order: complete ones with their points in Gmsh's sequence.
inline constexpr std::uint8_t gmshPyramid = 200;
inline constexpr std::uint8_t bezierTetrahedron = 78, bezierHexahedron = 79, bezierWedge = 80, bezierPyramid = 81;
}  // namespace cell_type

/// Corners of the parametric cell that a solid of this type is a linear or curved image of.
enum class Shape { None, Tet, Hexahedron, Wedge, Pyramid };

struct CellTypeInfo {
    const char* name;  ///< for people: "hexahedron"
    int dimension;     ///< 0 to 3, or −1 for a number that is no type
    int pointCount;    ///< of every cell of the type; 0 when it varies
    bool linear;       ///< a solid whose corners are all its points
    Shape shape;       ///< of a curved solid
};

CellTypeInfo cellTypeInfo(std::uint8_t type);

/// Faces of a linear solid (not of a polyhedron) as local points, outward counter-clockwise for a cell whose points are
/// in VTK's order; empty for other types.
std::span<const std::span<const std::uint8_t>> linearCellFaces(std::uint8_t type);

}  // namespace tetralux::mesh
