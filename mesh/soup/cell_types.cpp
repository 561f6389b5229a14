// SPDX-License-Identifier: Apache-2.0
#include <mesh/soup/cell_types.h>

#include <array>

namespace tetralux::mesh {
namespace {

using Face = std::span<const std::uint8_t>;
template <std::size_t n>
using Ids = std::array<std::uint8_t, n>;

constexpr Ids<3> tet0{1, 2, 3}, tet1{0, 3, 2}, tet2{0, 1, 3}, tet3{0, 2, 1};
constexpr std::array<Face, 4> tetrahedronFaces{tet0, tet1, tet2, tet3};

constexpr Ids<4> hex0{0, 4, 7, 3}, hex1{1, 2, 6, 5}, hex2{0, 1, 5, 4}, hex3{3, 7, 6, 2}, hex4{0, 3, 2, 1},
    hex5{4, 5, 6, 7};
constexpr std::array<Face, 6> hexahedronFaces{hex0, hex1, hex2, hex3, hex4, hex5};

constexpr Ids<4> vox0{0, 4, 6, 2}, vox1{1, 3, 7, 5}, vox2{0, 1, 5, 4}, vox3{2, 6, 7, 3}, vox4{0, 2, 3, 1},
    vox5{4, 5, 7, 6};
constexpr std::array<Face, 6> voxelFaces{vox0, vox1, vox2, vox3, vox4, vox5};

// VTK's wedge has its first triangle's normal pointing outwards.
constexpr Ids<3> wedge0{0, 1, 2}, wedge1{3, 5, 4};
constexpr Ids<4> wedge2{0, 3, 4, 1}, wedge3{1, 4, 5, 2}, wedge4{2, 5, 3, 0};
constexpr std::array<Face, 5> wedgeFaces{wedge0, wedge1, wedge2, wedge3, wedge4};

constexpr Ids<4> pyramid0{0, 3, 2, 1};
constexpr Ids<3> pyramid1{0, 1, 4}, pyramid2{1, 2, 4}, pyramid3{2, 3, 4}, pyramid4{3, 0, 4};
constexpr std::array<Face, 5> pyramidFaces{pyramid0, pyramid1, pyramid2, pyramid3, pyramid4};

constexpr Ids<5> penta0{0, 4, 3, 2, 1}, penta1{5, 6, 7, 8, 9};
constexpr Ids<4> penta2{0, 1, 6, 5}, penta3{1, 2, 7, 6}, penta4{2, 3, 8, 7}, penta5{3, 4, 9, 8}, penta6{4, 0, 5, 9};
constexpr std::array<Face, 7> pentagonalPrismFaces{penta0, penta1, penta2, penta3, penta4, penta5, penta6};

constexpr Ids<6> hexa0{0, 5, 4, 3, 2, 1}, hexa1{6, 7, 8, 9, 10, 11};
constexpr Ids<4> hexa2{0, 1, 7, 6}, hexa3{1, 2, 8, 7}, hexa4{2, 3, 9, 8}, hexa5{3, 4, 10, 9}, hexa6{4, 5, 11, 10},
    hexa7{5, 0, 6, 11};
constexpr std::array<Face, 8> hexagonalPrismFaces{hexa0, hexa1, hexa2, hexa3, hexa4, hexa5, hexa6, hexa7};

CellTypeInfo flatOrUnknown(std::uint8_t type) {
    switch (type) {
        case 0:
            return {"empty cell", 0, 0, false, Shape::None};
        case 1:
        case 2:
            return {"vertex", 0, 0, false, Shape::None};
        case 3:
        case 4:
        case 21:
        case 35:
        case 51:
        case 60:
        case 68:
        case 75:
            return {"line", 1, 0, false, Shape::None};
        case 5:
        case 6:
        case 22:
        case 34:
        case 54:
        case 61:
        case 69:
        case 76:
            return {"triangle", 2, 0, false, Shape::None};
        case 7:
        case 36:
        case 52:
        case 63:
            return {"polygon", 2, 0, false, Shape::None};
        case 8:
        case 9:
        case 23:
        case 28:
        case 30:
        case 53:
        case 62:
        case 70:
        case 77:
            return {"quadrilateral", 2, 0, false, Shape::None};
        case 41:
            return {"convex point set", 3, 0, false, Shape::None};
        default:
            return {"unknown cell type", -1, 0, false, Shape::None};
    }
}

}  // namespace

CellTypeInfo cellTypeInfo(std::uint8_t type) {
    using namespace cell_type;
    switch (type) {
        case tetrahedron:
            return {"tetrahedron", 3, 4, true, Shape::Tet};
        case voxel:
            return {"voxel", 3, 8, true, Shape::Hexahedron};
        case hexahedron:
            return {"hexahedron", 3, 8, true, Shape::Hexahedron};
        case wedge:
            return {"wedge", 3, 6, true, Shape::Wedge};
        case pyramid:
            return {"pyramid", 3, 5, true, Shape::Pyramid};
        case pentagonalPrism:
            return {"pentagonal prism", 3, 10, true, Shape::None};
        case hexagonalPrism:
            return {"hexagonal prism", 3, 12, true, Shape::None};
        case polyhedron:
            return {"polyhedron", 3, 0, true, Shape::None};
        case quadraticTetrahedron:
            return {"quadratic tetrahedron", 3, 10, false, Shape::Tet};
        case quadraticHexahedron:
            return {"quadratic hexahedron", 3, 20, false, Shape::Hexahedron};
        case triquadraticHexahedron:
            return {"triquadratic hexahedron", 3, 27, false, Shape::Hexahedron};
        case biquadraticQuadraticHexahedron:
            return {"biquadratic-quadratic hexahedron", 3, 24, false, Shape::Hexahedron};
        case quadraticWedge:
            return {"quadratic wedge", 3, 15, false, Shape::Wedge};
        case quadraticLinearWedge:
            return {"quadratic-linear wedge", 3, 12, false, Shape::Wedge};
        case biquadraticQuadraticWedge:
            return {"biquadratic-quadratic wedge", 3, 18, false, Shape::Wedge};
        case quadraticPyramid:
            return {"quadratic pyramid", 3, 13, false, Shape::Pyramid};
        case triquadraticPyramid:
            return {"triquadratic pyramid", 3, 19, false, Shape::Pyramid};
        case lagrangeTetrahedron:
            return {"Lagrange tetrahedron", 3, 0, false, Shape::Tet};
        case lagrangeHexahedron:
            return {"Lagrange hexahedron", 3, 0, false, Shape::Hexahedron};
        case lagrangeWedge:
            return {"Lagrange wedge", 3, 0, false, Shape::Wedge};
        case lagrangePyramid:
            return {"Lagrange pyramid", 3, 0, false, Shape::Pyramid};
        case gmshPyramid:
            return {"curved pyramid", 3, 0, false, Shape::Pyramid};
        case bezierTetrahedron:
            return {"Bézier tetrahedron", 3, 0, false, Shape::Tet};
        case bezierHexahedron:
            return {"Bézier hexahedron", 3, 0, false, Shape::Hexahedron};
        case bezierWedge:
            return {"Bézier wedge", 3, 0, false, Shape::Wedge};
        case bezierPyramid:
            return {"Bézier pyramid", 3, 0, false, Shape::Pyramid};
        default:
            return flatOrUnknown(type);
    }
}

std::span<const std::span<const std::uint8_t>> linearCellFaces(std::uint8_t type) {
    using namespace cell_type;
    switch (type) {
        case tetrahedron:
            return tetrahedronFaces;
        case voxel:
            return voxelFaces;
        case hexahedron:
            return hexahedronFaces;
        case wedge:
            return wedgeFaces;
        case pyramid:
            return pyramidFaces;
        case pentagonalPrism:
            return pentagonalPrismFaces;
        case hexagonalPrism:
            return hexagonalPrismFaces;
        default:
            return {};
    }
}

}  // namespace tetralux::mesh
