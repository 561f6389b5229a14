// SPDX-License-Identifier: Apache-2.0
//
// tetralux extract.
#include "command_line_test.h"

namespace tetralux::tests {
namespace {

using ExtractCommand = CommandLine;

TEST_F(ExtractCommand, TellsWhatItWrote) {
    write("corner.vtu", vtuText(cornerTetrahedron(5)));
    EXPECT_EQ(tetralux("extract corner.vtu --boundary -o a.stl").out,
              "a.stl: 4 triangles, 4 points, area 25.79795897, closed, encloses 5.333333333\n");
    EXPECT_EQ(tetralux("extract corner.vtu --slice 0,0,1,0,0,1 -o a.ply").out,
              "a.ply: 1 triangles, 3 points, area 2, 3 open edges\n");
    EXPECT_EQ(tetralux("extract bucky:8 --isosurface 0.3 -o a.vtp --quiet").out, "");
    for (const char* name : {"a.stl", "a.ply", "a.vtp"}) EXPECT_TRUE(exists(name));
    expectGood("render bucky:4 --size 8x8 -o a.png --quiet --surface a.vtp");
}

TEST_F(ExtractCommand, SeesWhatRenderDoes) {
    // a point with no value takes its cell away
    TinyMesh mesh = cornerTetrahedron(0);
    mesh.points.push_back({4, 4, 2});
    mesh.cells.push_back({1, 2, 3, 4});
    mesh.values = {0, 1, 1, 1, 1e300};
    write("half.vtu", vtuText(mesh));
    EXPECT_EQ(tetralux("extract half.vtu --isosurface 0.5 -o a.vtp").out.rfind("a.vtp: 1 triangles, 3 points", 0), 0u);
}

TEST_F(ExtractCommand, CellFieldsBecomeLinearFirst) {
    expectRefused("extract damaged.vtu --boundary -o a.vtp", {"damaged.vtu"});
    write("cells.vtk",
          "# vtk DataFile Version 3.0\na\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 5 double\n0 0 0 1 0 0 0 1 0 0 0 1 0 "
          "0 -1\n"
          "CELLS 2 10\n4 0 1 2 3\n4 0 2 1 4\nCELL_TYPES 2\n10 10\nCELL_DATA 2\nSCALARS c double 1\nLOOKUP_TABLE "
          "default\n0 1\n");
    expectRefused("extract cells.vtk --isosurface 0.25 -o a.vtp", {"cells.vtk", "'c'", "--smooth-cells"});
    EXPECT_EQ(
        tetralux("extract cells.vtk --isosurface 0.25 --smooth-cells -o a.vtp").out.rfind("a.vtp: 1 triangles", 0), 0u);
}

TEST_F(ExtractCommand, RefusesWhatCannotBe) {
    write("broken.vtu", "<VTKFile type=\"UnstructuredGrid\">");
    expectRefused("extract broken.vtu --boundary -o a.vtp", {"broken.vtu"});
    expectRefused("extract bucky:4 -o a.vtp", {"--isosurface", "--slice", "--boundary"});
    expectRefused("extract bucky:4 -o a.vtp --boundary --isosurface 0.5", {"2 surfaces"});
    expectRefused("extract bucky:4 --boundary", {"--output"});
    expectRefused("extract bucky:4 --boundary -o a.obj", {"a.obj", ".vtp, .ply or .stl"});
    expectRefused("extract bucky:4 --boundary -o missing/a.vtp", {"missing"});
    expectRefused("extract bucky:4 --boundary --scalar density -o a.vtp", {"--scalar"});
    expectRefused("extract bucky:4 --isosurface 7 -o a.vtp", {"bucky:4", "--isosurface 7", "density"});
    expectRefused("extract bucky:4 --isosurface nan -o a.vtp", {"--isosurface", "nan"});
    expectRefused("extract bucky:4 --isosurface 0.5 --scalar pressure -o a.vtp", {"pressure", "density"});
    expectRefused("extract bucky:4 --slice 0,0,9,0,0,1 -o a.vtp", {"0,0,9", "misses"});
    expectRefused("extract bucky:4 --slice 0,0,0,0,0,0 -o a.vtp", {"--slice", "0,0,0"});
}

}  // namespace
}  // namespace tetralux::tests
