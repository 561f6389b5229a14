// SPDX-License-Identifier: Apache-2.0
//
// Surfaces: read from files, and cut out of a mesh by a plane.
#include <filesystem>
#include <fstream>
#include <map>

#include <gtest/gtest.h>
#include <unistd.h>
#include <glm/geometric.hpp>

#include <mesh/io/read_surface.h>
#include <mesh/tet/plane_cut.h>
#include <tests/support/analytic_scenes.h>

namespace tetralux::mesh {
namespace {

double area(const SurfaceMesh& surface) {
    double sum = 0;
    for (const auto& [a, b, c] : surface.triangles)
        sum += 0.5 * glm::length(glm::cross(surface.positions[b] - surface.positions[a],
                                            surface.positions[c] - surface.positions[a]));
    return sum;
}

class ReadSurface : public testing::Test {
protected:
    ReadSurface()
        : folder_(std::filesystem::temp_directory_path() / ("tetralux-surface-" + std::to_string(::getpid()))) {
        std::filesystem::create_directories(folder_);
    }
    ~ReadSurface() override { std::filesystem::remove_all(folder_); }

    std::string write(const std::string& name, const std::string& text) const {
        std::ofstream(folder_ / name, std::ios::binary) << text;
        return (folder_ / name).string();
    }
    static std::string errorOf(const std::string& path) {
        try {
            readSurface(path, true);  // in a child process: the PLY reader of VTK does not survive its input
        } catch (const std::runtime_error& error) {
            return error.what();
        }
        return "";
    }

    std::filesystem::path folder_;
};

// A square of side 2 and a triangle of area 1/2 in the plane z = 1, in every format.
constexpr const char* plyText = R"(ply
format ascii 1.0
element vertex 5
property double x
property double y
property double z
element face 2
property list uchar int vertex_indices
end_header
0 0 1
2 0 1
2 2 1
0 2 1
3 0 1
4 0 1 2 3
3 1 4 2
)";
constexpr const char* offText = R"(OFF
# a comment
5 2 0
0 0 1
2 0 1
2 2 1 255 0 0
0 2 1
3 0 1
4 0 1 2 3  0.5 0.5 0.5
3 1 4 2
)";
constexpr const char* objText = "v 0 0 1\nv 2 0 1\nv 2 2 1\nv 0 2 1\nv 3 0 1\nf 1 2 3 4\nf 2 5 3\n";
constexpr const char* vtkText = R"(# vtk DataFile Version 3.0
a
ASCII
DATASET POLYDATA
POINTS 5 double
0 0 1 2 0 1 2 2 1 0 2 1 3 0 1
POLYGONS 2 9
4 0 1 2 3
3 1 4 2
)";
constexpr const char* vtpText = R"(<?xml version="1.0"?>
<VTKFile type="PolyData" version="1.0" byte_order="LittleEndian"><PolyData>
<Piece NumberOfPoints="5" NumberOfPolys="2"><Points><DataArray type="Float64" NumberOfComponents="3" format="ascii">
0 0 1 2 0 1 2 2 1 0 2 1 3 0 1</DataArray></Points><Polys>
<DataArray type="Int64" Name="connectivity" format="ascii">0 1 2 3 1 4 2</DataArray>
<DataArray type="Int64" Name="offsets" format="ascii">4 7</DataArray></Polys></Piece></PolyData></VTKFile>
)";
constexpr const char* stlText = R"(solid a
facet normal 0 0 1
outer loop
vertex 0 0 1
vertex 2 0 1
vertex 2 2 1
endloop
endfacet
facet normal 0 0 1
outer loop
vertex 0 0 1
vertex 2 2 1
vertex 0 2 1
endloop
endfacet
facet normal 0 0 1
outer loop
vertex 2 0 1
vertex 3 0 1
vertex 2 2 1
endloop
endfacet
endsolid a
)";

TEST_F(ReadSurface, EveryFormatGivesTheSamePolygons) {
    for (const auto& [name, text] :
         {std::pair("a.ply", plyText), std::pair("a.off", offText), std::pair("a.OBJ", objText),
          std::pair("a.vtk", vtkText), std::pair("a.vtp", vtpText), std::pair("a.stl", stlText)}) {
        const SurfaceMesh surface = readSurface(write(name, text));
        EXPECT_EQ(surface.triangles.size(), 3u) << name;
        EXPECT_EQ(surface.positions.size(), 5u) << name;
        EXPECT_NEAR(area(surface), 5.0, 1e-12) << name;
        for (const glm::dvec3& p : surface.positions) EXPECT_EQ(p.z, 1.0) << name;
    }
}

TEST_F(ReadSurface, BadFilesAreRefusedInOneLine) {
    const auto whole = std::string(offText);
    std::map<std::string, std::string> broken{
        {"empty.stl", ""},
        {"noise.stl", std::string("\x01\x02not a mesh\xff")},
        {"noise.ply", "noise"},
        {"noise.vtp", "noise"},
        {"noise.obj", "noise"},
        {"cut.ply", std::string(plyText).substr(0, 150)},
        {"cut.stl", std::string(80, ' ') + std::string("\x02\0\0\0", 4) + std::string(60, '\0')},
        {"cut.off", whole.substr(0, whole.size() - 9)},
        {"wrong.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 7\n"},
        {"huge.off", "OFF\n99999999999 1 0\n0 0 0\n"},
        {"nan.off", "OFF\n3 1 0\n0 0 nan\n1 0 0\n0 1 0\n3 0 1 2\n"},
        {"points.off", "OFF\n3 0 0\n0 0 0\n1 0 0\n0 1 0\n"},
        {"other.xyz", "0 0 0\n"},
    };
    for (const auto& [name, text] : broken) {
        const std::string path = write(name, text), error = errorOf(path);
        EXPECT_EQ(error.rfind(path + ": ", 0), 0u) << name << ": '" << error << "'";
        EXPECT_EQ(error.find('\n'), std::string::npos) << error;
        EXPECT_EQ(error.find(path + ": " + path), std::string::npos) << error;
    }
    EXPECT_NE(errorOf((folder_ / "missing.stl").string()).find("no such surface file; check the path"),
              std::string::npos);
}

double linear(const glm::dvec3& x) {
    return 1.0 + 2.0 * x.x - 3.0 * x.y + 0.5 * x.z;
}

TEST(PlaneCut, CutsACubeInTheRightAreaWithTheLinearScalar) {
    const ScalarMesh cube = test::jitteredBoxMesh(6, 0.3, 7, linear);
    const struct {
        glm::dvec3 point, normal;
        double area;
    } planes[] = {{{0.5, 0.5, 0.37}, {0, 0, 2}, 1.0},
                  {{0.5, 0.5, 0.5}, {1, 1, 0}, std::sqrt(2.0)},
                  {{0.5, 0.5, 0.5}, {1, 1, 1}, 0.75 * std::sqrt(3.0)}};  // a regular hexagon of side √½
    for (const auto& plane : planes) {
        const SurfaceMesh cut = cutByPlane(cube, plane.point, plane.normal);
        EXPECT_NEAR(area(cut), plane.area, 1e-12);
        ASSERT_EQ(cut.scalars.size(), cut.positions.size());
        for (std::size_t i = 0; i < cut.positions.size(); ++i) {
            EXPECT_NEAR(glm::dot(cut.positions[i] - plane.point, glm::normalize(plane.normal)), 0.0, 1e-14);
            EXPECT_NEAR(cut.scalars[i], linear(cut.positions[i]), 1e-13);
        }
    }
}

TEST(PlaneCut, InnerEdgesAreSharedByTwoTriangles) {
    const SurfaceMesh cut = cutByPlane(test::jitteredBoxMesh(5, 0.3, 3, linear), {0.5, 0.5, 0.5}, {0.3, 0.5, 1});
    std::map<std::pair<PointIndex, PointIndex>, int> edges;
    for (const auto& t : cut.triangles)
        for (std::size_t k = 0; k < 3; ++k) ++edges[std::minmax(t[k], t[(k + 1) % 3])];
    double boundary = 0;
    for (const auto& [edge, count] : edges) {
        EXPECT_LE(count, 2);
        const glm::dvec3 middle = 0.5 * (cut.positions[edge.first] + cut.positions[edge.second]);
        bool outside = false;
        for (int axis = 0; axis < 3; ++axis) outside = outside || middle[axis] < 1e-9 || middle[axis] > 1 - 1e-9;
        EXPECT_EQ(count == 1, outside) << "an edge without a partner is one of the cube's surface";
        boundary += count == 1 ? 1 : 0;
    }
    EXPECT_GT(boundary, 4);
}

TEST(PlaneCut, PlanesAlongFacesTakeThemOnce) {
    const ScalarMesh cube = test::boxMesh(5, linear);
    for (const double height : {0.0, 0.25, 1.0})
        EXPECT_NEAR(area(cutByPlane(cube, {0.1, 0.2, height}, {0, 0, 1})), 1.0, 1e-12) << height;
    for (const double height : {-0.01, 1.01})
        EXPECT_TRUE(cutByPlane(cube, {0.1, 0.2, height}, {0, 0, 1}).triangles.empty()) << height;
}

TEST(PlaneCut, CellDataGivesOneScalarPerTriangle) {
    ScalarMesh cube = test::boxMesh(3, linear);
    cube.association = Association::Cell;
    cube.scalars.resize(cube.cells.size());
    for (std::size_t i = 0; i < cube.scalars.size(); ++i) cube.scalars[i] = static_cast<double>(i);
    const SurfaceMesh cut = cutByPlane(cube, {0.5, 0.5, 0.3}, {0, 0, 1});
    EXPECT_EQ(cut.association, Association::Cell);
    ASSERT_EQ(cut.scalars.size(), cut.triangles.size());
    for (std::size_t i = 0; i < cut.triangles.size(); ++i) {
        glm::dvec3 centre(0);
        for (const PointIndex p : cut.triangles[i]) centre += cut.positions[p] / 3.0;
        const auto& cell = cube.cells[static_cast<std::size_t>(cut.scalars[i])];
        for (std::size_t k = 0; k < 4; ++k) {  // the triangle's centre is inside the cell whose value it has
            auto moved = std::array{cube.positions[cell[0]], cube.positions[cell[1]], cube.positions[cell[2]],
                                    cube.positions[cell[3]]};
            moved[k] = centre;
            EXPECT_GT(sixVolumes(moved[0], moved[1], moved[2], moved[3]), 0.0);
        }
    }
}

}  // namespace
}  // namespace tetralux::mesh
