// SPDX-License-Identifier: Apache-2.0
//
// What programs write that is not as the formats' own libraries have it: arrays in any order or none, old numberings,
// restarted series, names in quotes.
#include "small_files.h"

namespace tetralux::mesh {
namespace {

using namespace test;

ReadOptions atTime(double time) {
    ReadOptions options;
    options.time = time;
    return options;
}

ReadOptions inPieces(int subdivision) {
    ReadOptions options;
    options.subdivision = subdivision;
    return options;
}

/// A tetrahedron per piece, with the arrays `first` and `second` in it.
std::string vtuOfPieces(const std::string& order, const std::vector<std::string>& pieces) {
    std::string text = "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"" + order +
                       "\"><!-- two --><UnstructuredGrid>";
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        text += fmt::format(
            "<Piece NumberOfPoints=\"4\" NumberOfCells=\"1\"><PointData>{1}</PointData><Points><DataArray "
            "type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">{0} 0 0 {0} 1 0 {0} 0 1 {2} 0 "
            "0</DataArray></Points><Cells><DataArray type=\"Int64\" Name=\"connectivity\" format=\"ascii\">0 1 2 "
            "3</DataArray><DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">4</DataArray><DataArray "
            "type=\"UInt8\" Name=\"types\" format=\"ascii\">10</DataArray></Cells></Piece>",
            2 * i, pieces[i], 2 * i + 1);
    }
    return text + "</UnstructuredGrid></VTKFile>";
}

std::string array(const std::string& name, const std::string& values) {
    return "<DataArray type=\"Float64\" Name=\"" + name + "\" format=\"ascii\">" + values + "</DataArray>";
}

TEST(Dialects, ArraysOfPiecesGoByTheirNames) {
    const TemporaryFolder folder;
    const std::string t = array("T", "1 2 1 2"), p = array("p", "100 100 100 100");
    for (const char* order : {"LittleEndian", "BigEndian"}) {
        SCOPED_TRACE(order);
        const ReadResult swapped = readMesh(folder.write("a.vtu", vtuOfPieces(order, {t + p, p + t})));
        ASSERT_EQ(swapped.mesh.fields.size(), 2u);
        for (const Field& field : swapped.mesh.fields) {
            const auto [low, high] = std::minmax_element(field.values.begin(), field.values.end());
            EXPECT_EQ(*low, field.name == "T" ? 1.0 : 100.0);
            EXPECT_EQ(*high, field.name == "T" ? 2.0 : 100.0);
        }
        ReadResult lacking = readMesh(folder.write("a.vtu", vtuOfPieces(order, {t + p, p})));
        ASSERT_EQ(lacking.mesh.cells.size(), 2u);
        const ScalarSelection selection = selectScalar(std::move(lacking.mesh), "T", lacking.report);
        EXPECT_EQ(selection.nonFiniteCells, 1u);
        EXPECT_EQ(selection.mesh.cells.size(), 1u);
        EXPECT_EQ(selection.mesh.scalarMax, 2.0);
        // A field that only a later piece has.
        EXPECT_EQ(readMesh(folder.write("a.vtu", vtuOfPieces(order, {p, t}))).mesh.fields.size(), 2u);
    }
}

/// Two halves of a row of four voxels, of which each file tells the extent of the whole.
TEST(Dialects, GridsInPieces) {
    const TemporaryFolder folder;
    const auto half = [&](const std::string& name, const std::string& extent, const std::string& values) {
        folder.write(name,
                     "<VTKFile type=\"ImageData\" version=\"1.0\"><ImageData WholeExtent=\"0 4 0 1 0 1\" "
                     "Origin=\"0 0 0\" Spacing=\"1 1 1\"><Piece Extent=\"" +
                         extent + "\"><CellData>" + values + "</CellData></Piece></ImageData></VTKFile>");
    };
    half("a.vti", "0 2 0 1 0 1", array("c", "1 2.d0") + array("d", "5 6"));
    half("b.vti", "2 4 0 1 0 1", array("d", "7 8") + array("c", "3 4"));
    const ReadResult result = readMesh(
        folder.write("a.pvti",
                     "<VTKFile type=\"PImageData\" version=\"1.0\"><PImageData WholeExtent=\"0 4 0 1 0 1\" "
                     "GhostLevel=\"0\"><Piece Extent=\"0 2 0 1 0 1\" Source=\"a.vti\"/><Piece Extent=\"2 4 0 1 0 1\" "
                     "Source=\"b.vti\"/></PImageData></VTKFile>"));
    EXPECT_NEAR(totalVolume(result.mesh), 4.0, 1e-14);
    EXPECT_TRUE(result.report.defects.empty());
    for (const Field& field : result.mesh.fields) {
        EXPECT_EQ(field.values.front(), field.name == "c" ? 1.0 : 5.0);
        EXPECT_EQ(field.values.back(), field.name == "c" ? 4.0 : 8.0);
    }
}

TEST(Dialects, BlocksMayLackFieldsAndTheFirstWithAValueIsShown) {
    const TemporaryFolder folder;
    const std::string nan = array("lost", "nan nan nan nan"), t = array("T", "1 2 3 4");
    folder.write("solid.vtu", vtuOfPieces("LittleEndian", {nan + t}));
    folder.write("wall.vtu", replaced(replaced(vtuOfPieces("LittleEndian", {array("shear", "1 1 1 1")}), ">10<", ">5<"),
                                      "0 1 2 3</DataArray><DataArray type=\"Int64\" Name=\"offsets\" "
                                      "format=\"ascii\">4",
                                      "0 1 2</DataArray><DataArray type=\"Int64\" Name=\"offsets\" "
                                      "format=\"ascii\">3"));
    ReadResult result = readMesh(
        folder.write("a.vtm",
                     "<VTKFile type=\"vtkMultiBlockDataSet\" version=\"1.0\"><vtkMultiBlockDataSet><Block index=\"0\">"
                     "<DataSet index=\"0\" name=\"wall\" file=\"wall.vtu\"/></Block><DataSet index=\"1\" "
                     "file = 'solid.vtu'/></vtkMultiBlockDataSet></VTKFile>"));
    EXPECT_EQ(result.report.cellsRead, 2u);
    ScalarSelection selection = selectScalar(std::move(result.mesh), "", result.report);
    EXPECT_EQ(selection.fieldName, "T");
    EXPECT_EQ(selection.nonFiniteCells, 0u);
    expectError(
        [&] {
            readMesh(folder.write("circle.vtm",
                                  "<VTKFile><vtkMultiBlockDataSet><DataSet file=\"circle.vtm\"/></vtkMultiBlockDataSet>"
                                  "</VTKFile>"));
        },
        "in a circle");
}

/// A hexahedron with three points along each edge. VTK 8 numbered the last two upright edges the other way round.
std::string hexahedronOfOrderTwo(const std::string& version, const std::string& order, int type, bool old) {
    std::vector<glm::dvec3> points{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                                   {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
    for (const auto& [a, b] :
         {std::pair{0, 1}, {1, 2}, {3, 2}, {0, 3}, {4, 5}, {5, 6}, {7, 6}, {4, 7}, {0, 4}, {1, 5}, {2, 6}, {3, 7}}) {
        points.push_back(0.5 * (points[static_cast<std::size_t>(a)] + points[static_cast<std::size_t>(b)]));
    }
    for (const glm::dvec3& face :
         {glm::dvec3(0, .5, .5), {1, .5, .5}, {.5, 0, .5}, {.5, 1, .5}, {.5, .5, 0}, {.5, .5, 1}}) {
        points.push_back(face);
    }
    points.push_back(glm::dvec3(0.5));
    if (old) {
        std::swap(points[18], points[19]);
    }
    std::string text, ids;
    for (std::size_t i = 0; i < points.size(); ++i) {
        text += fmt::format("{} {} {} ", points[i].x, points[i].y, points[i].z);
        ids += fmt::format("{} ", i);
    }
    return fmt::format(
        "<VTKFile type=\"UnstructuredGrid\" {} byte_order=\"{}\"><UnstructuredGrid><Piece NumberOfPoints=\"27\" "
        "NumberOfCells=\"1\"><Points><DataArray type=\"Float64\" NumberOfComponents=\"3\" "
        "format=\"ascii\">{}</DataArray></Points><Cells><DataArray type=\"Int64\" Name=\"connectivity\" "
        "format=\"ascii\">{}</DataArray><DataArray type=\"Int64\" Name=\"offsets\" "
        "format=\"ascii\">27</DataArray><DataArray type=\"UInt8\" Name=\"types\" "
        "format=\"ascii\">{}</DataArray></Cells></Piece></UnstructuredGrid></VTKFile>",
        version.empty() ? "" : "version=\"" + version + "\"", order, text, ids, type);
}

TEST(Dialects, HexahedraOfVtk8AreRenumberedByTheVersionOfTheFile) {
    const TemporaryFolder folder;
    for (const char* order : {"LittleEndian", "BigEndian"}) {
        for (const int type : {cell_type::lagrangeHexahedron, cell_type::bezierHexahedron}) {
            const auto folded = [&](const std::string& version, bool old) {
                const ReadResult result =
                    readMesh(folder.write("h.vtu", hexahedronOfOrderTwo(version, order, type, old)));
                return std::abs(totalVolume(result.mesh) - 1.0) > 1e-3;
            };
            EXPECT_FALSE(folded("1.0", true));
            EXPECT_FALSE(folded("2.0", true));
            EXPECT_FALSE(folded("2.1", false));
            EXPECT_FALSE(folded("2.2", false));
            EXPECT_TRUE(folded("1.0", false));
            EXPECT_TRUE(folded("2.2", true));
        }
    }
}

TEST(Dialects, ComponentsGoByTheirNames) {
    const TemporaryFolder folder;
    const std::string named =
        "<DataArray type=\"Float64\" Name=\"S\" NumberOfComponents=\"2\" ComponentName0=\"x:x\" ComponentName1=\"xy\" "
        "format=\"ascii\">1 2 3 4 5 6 7 8</DataArray>";
    const std::string legacy =
        "# vtk DataFile Version 5.1\nx\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 4 double\n0 0 0 1 0 0 0 1 0 0 0 1\n"
        "CELLS 2 4\nOFFSETS vtktypeint64\n0 4\nCONNECTIVITY vtktypeint64\n0 1 2 3\nCELL_TYPES 1\n10\nPOINT_DATA 4\n"
        "FIELD f 1\nS 2 4 double\n1 2 3 4 5 6 7 8\nMETADATA\nCOMPONENT_NAMES\nx:x\nxy\n\n";
    for (const std::string& source :
         {folder.write("a.vtu", vtuOfPieces("LittleEndian", {named})),
          folder.write("b.vtu", vtuOfPieces("BigEndian", {named})), folder.write("a.vtk", legacy)}) {
        SCOPED_TRACE(source);
        const auto highest = [&](const std::string& name) {
            ReadResult result = readMesh(source);
            const ScalarSelection selection = selectScalar(std::move(result.mesh), name, result.report);
            return std::pair(selection.mesh.scalarMax, selection.fieldName);
        };
        EXPECT_EQ(highest("S:x:x"), (std::pair(7.0, std::string("S (x:x)"))));
        EXPECT_EQ(highest("S:xy"), (std::pair(8.0, std::string("S (xy)"))));
        EXPECT_EQ(highest("S:1"), (std::pair(8.0, std::string("S (xy)"))));
        expectError([&] { highest("S:yy"); }, "field 'S' has no component 'yy'; it has 2 (0 to 1, x:x, xy)");
    }
}

TEST(Dialects, AFieldOnCellsBesideOneOfTheSameNameOnPoints) {
    const TemporaryFolder folder;
    const std::string source =
        folder.write("a.vtu", replaced(vtuOfPieces("LittleEndian", {array("T", "1 2 3 4")}), "</PointData>",
                                       "</PointData><CellData>" + array("T", "50") + "</CellData>"));
    const auto highest = [&](const std::string& name) {
        ReadResult result = readMesh(source);
        return selectScalar(std::move(result.mesh), name, result.report).mesh.scalarMax;
    };
    EXPECT_EQ(highest("T"), 4.0);
    EXPECT_EQ(highest("T@points"), 4.0);
    EXPECT_EQ(highest("T@cells"), 50.0);
    expectError([&] { highest("T@faces"); }, "no field named 'T@faces'; the mesh has 'T' (points), 'T' (cells)");
}

TEST(Dialects, OfTwoFilesForOneTimeTheLaterCounts) {
    const TemporaryFolder folder;
    for (const char* name : {"old", "new", "other"}) {
        folder.write(fmt::format("{}.vtu", name),
                     vtuOfPieces("LittleEndian", {array("T", std::string(name) == "old" ? "1 1 1 1" : "2 2 2 2")}));
    }
    const auto series = [&](const std::string& entries) {
        return readMesh(
            folder.write("a.pvd", "<VTKFile type=\"Collection\"><Collection>" + entries + "</Collection></VTKFile>"),
            atTime(1.0));
    };
    const auto entry = [](const char* time, const char* rest) {
        return fmt::format("<DataSet timestep=\"{}\" {}/>", time, rest);
    };
    const ReadResult restarted =
        series(entry("0", "part='0' file='other.vtu'") + entry("1", "part='0' file='old.vtu'") +
               entry("0", "part='0' file='other.vtu'") + entry("1.0D0", "file='new.vtu'"));
    EXPECT_EQ(restarted.mesh.cells.size(), 1u);
    EXPECT_EQ(restarted.mesh.fields.at(0).values.at(0), 2.0);
    EXPECT_EQ(restarted.report.notes,
              (std::vector<std::string>{"two files for time 1: the later one, new.vtu, counts and old.vtu does not"}));
    EXPECT_EQ(restarted.times, (std::vector<double>{0.0, 1.0}));
    const ReadResult parts = series(entry("1", "part='0' file='old.vtu'") + entry("1", "part='1' file='new.vtu'"));
    EXPECT_EQ(parts.report.cellsRead, 2u);
    EXPECT_TRUE(parts.report.notes.empty());
}

TEST(Dialects, StepsOfVtkHdf) {
    const std::string source = std::string(TETRALUX_TEST_DATA) + "/steps.vtkhdf";
    for (const double t : {0.0, 0.5, 2.0}) {
        const ReadResult result = readMesh(source, atTime(t + 0.1));
        EXPECT_EQ(result.times, (std::vector<double>{0.0, 0.5, 2.0}));
        EXPECT_NEAR(totalVolume(result.mesh), 2.0, 1e-14);
        ASSERT_EQ(result.mesh.fields.size(), 2u);
        EXPECT_LT(largestError(result.mesh, [&](const glm::dvec3& x) { return x.x + 10.0 * t; }), 1e-14);
        EXPECT_EQ(result.mesh.fields[1].values.front(), 100.0 * t);
        EXPECT_EQ(result.mesh.fields[1].values.back(), 100.0 * t + 1.0);
        const auto right = [](const glm::dvec3& a, const glm::dvec3& b) { return a.x < b.x; };
        EXPECT_EQ(std::max_element(result.mesh.positions.begin(), result.mesh.positions.end(), right)->x, 4.0 + t);
    }
    EXPECT_EQ(readMesh(source).mesh.fields.at(1).values.front(), 0.0);
    expectError([&] { readMesh(std::string(TETRALUX_TEST_DATA) + "/surface.vtkhdf"); }, "is a surface (PolyData)");
}

/// Complete elements as Gmsh 4.15 numbers them, places in steps of 1 / order.
struct GmshSample {
    int type, order;
    double volume;
    const char* points;
};
const std::array gmshSamples{
    GmshSample{30, 4, 1.0 / 6.0,
               "000 400 040 004 100 200 300 310 220 130 030 020 010 003 002 001 013 022 031 103 202 301 110 120 210 "
               "101 201 102 011 012 021 112 211 121 111"},
    GmshSample{92, 3, 1.0,
               "000 300 330 030 003 303 333 033 100 200 010 020 001 002 310 320 301 302 230 130 331 332 031 032 103 "
               "203 013 023 313 323 233 133 110 120 220 210 101 201 202 102 011 012 022 021 311 321 322 312 231 131 "
               "132 232 113 213 223 123 111 211 221 121 112 212 222 122"},
    GmshSample{91, 4, 0.5,
               "000 400 040 004 404 044 100 200 300 010 020 030 001 002 003 310 220 130 401 402 403 041 042 043 104 "
               "204 304 014 024 034 314 224 134 110 120 210 114 214 124 101 301 303 103 201 302 203 102 202 011 013 "
               "033 031 012 023 032 021 022 311 131 133 313 221 132 223 312 222 111 113 112 211 213 212 121 123 122"},
    GmshSample{119, 4, 1.0 / 3.0,
               "000 400 440 040 004 100 200 300 010 020 030 001 002 003 410 420 430 301 202 103 340 240 140 331 222 "
               "113 031 022 013 101 201 102 021 011 012 311 321 212 231 131 122 110 130 330 310 120 230 320 210 220 "
               "111 211 221 121 112"},
    GmshSample{118, 3, 1.0 / 3.0,
               "000 300 330 030 003 100 200 010 020 001 002 310 320 201 102 230 130 221 112 021 012 101 011 211 121 "
               "110 120 220 210 111"},
    GmshSample{14, 2, 1.0 / 3.0, "000 200 220 020 002 100 010 001 210 101 120 111 011 110"},
};

std::string gmshFile(const GmshSample& sample, const std::function<glm::dvec3(const glm::dvec3&)>& warp,
                     const std::function<double(const glm::dvec3&)>& field) {
    std::string nodes, values, ids;
    std::istringstream places(sample.points);
    int count = 0;
    for (std::string place; places >> place;) {
        const glm::dvec3 x =
            glm::dvec3(place[0] - '0', place[1] - '0', place[2] - '0') / static_cast<double>(sample.order);
        const glm::dvec3 y = warp(x);
        ++count;
        nodes += fmt::format("{} {} {} {}\n", count, y.x, y.y, y.z);
        values += fmt::format("{} {}\n", count, field(y));
        ids += fmt::format(" {}", count);
    }
    return fmt::format(
        "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n{0}\n{1}$EndNodes\n$Elements\n1\n1 {2} 2 1 "
        "1{3}\n$EndElements\n$NodeData\n1\n\"s\"\n1\n0\n3\n0\n1\n{0}\n{4}$EndNodeData\n",
        count, nodes, sample.type, ids, values);
}

TEST(Dialects, GmshElementsOfAnyOrder) {
    const TemporaryFolder folder;
    for (const GmshSample& sample : gmshSamples) {
        SCOPED_TRACE(sample.type);
        // A polynomial of the element's own order is met between its points too.
        const auto field = [&](const glm::dvec3& x) {
            return 1.0 + x.x - 2.0 * std::pow(x.y, sample.order) + x.x * std::pow(x.z, sample.order - 1);
        };
        ReadResult result =
            readMesh(folder.write("a.msh", gmshFile(sample, straight, field)), inPieces(2 * sample.order + 1));
        std::erase_if(result.mesh.fields, [](const Field& f) { return f.name != "s"; });
        EXPECT_NEAR(totalVolume(result.mesh), sample.volume, 1e-12);
        EXPECT_LT(largestError(result.mesh, field), 1e-11);
        // Layers that slide over each other keep the volume.
        const auto slide = [](const glm::dvec3& x) { return x + glm::dvec3(0.4 * x.z * x.z, 0.0, 0.0); };
        EXPECT_NEAR(totalVolume(readMesh(folder.write("a.msh", gmshFile(sample, slide, field))).mesh), sample.volume,
                    1e-12);
    }
    expectError(
        [&] {
            readMesh(folder.write("a.msh", gmshFile({99, 3, 1.0, "000"}, straight, linearField)));
        },
        "has elements of Gmsh's type 99, which is not known");
}

TEST(Dialects, GmshOfVersionOne) {
    const TemporaryFolder folder;
    const ReadResult result = readMesh(folder.write("a.msh",
                                                    "$Comments\nany words\n$EndComments\n$NOD\n5\n1 0 0 0\n2 1 0 0\n3 "
                                                    "0 1 0\n4 0 0 1\n7 1 1 1\n$ENDNOD\n$ELM\n3\n1 2 5 1 3 1 2 3\n2 4 "
                                                    "7 1 4 1 2 3 4\n3 4 8 2 4 2 3 4 7\n$ENDELM\n"));
    EXPECT_NEAR(totalVolume(result.mesh), smallMeshVolume, 1e-14);
    EXPECT_EQ(result.report.cellTypes.at("triangle"), 1u);
}

TEST(Dialects, ExodusElementsThatWouldBeScrambledAreNamed) {
    expectError([] { readMesh(std::string(TETRALUX_TEST_DATA) + "/pyramid14.e"); },
                "its block 1 has elements of type PYRAMID with 14 nodes, which are not read; write them with 5, 13");
}

/// Linear types with the points of quadratic cells, as some converters write them.
TEST(Dialects, TypesAreTakenByTheirNumberOfPoints) {
    const auto file = [](int type, const std::string& points, int count) {
        std::string ids;
        for (int i = 0; i < count; ++i) {
            ids += fmt::format("{} ", i);
        }
        return fmt::format(
            "<VTKFile type=\"UnstructuredGrid\" version=\"2.2\" byte_order=\"LittleEndian\"><UnstructuredGrid><Piece "
            "NumberOfPoints=\"{0}\" NumberOfCells=\"1\"><Points><DataArray type=\"Float64\" NumberOfComponents=\"3\" "
            "format=\"ascii\">{1}</DataArray></Points><Cells><DataArray type=\"Int64\" Name=\"connectivity\" "
            "format=\"ascii\">{2}</DataArray><DataArray type=\"Int64\" Name=\"offsets\" "
            "format=\"ascii\">{0}</DataArray><DataArray type=\"UInt8\" Name=\"types\" "
            "format=\"ascii\">{3}</DataArray></Cells></Piece></UnstructuredGrid></VTKFile>",
            count, points, ids, type);
    };
    const std::string hexahedron =
        "0 0 0 2 0 0 2 2 0 0 2 0 0 0 2 2 0 2 2 2 2 0 2 2 1 0 0 2 1 0 1 2 0 0 1 0 1 0 2 2 1 2 1 2 2 0 1 2 0 0 1 2 0 1 2 "
        "2 1 0 2 1";
    const std::string tetrahedron = "0 0 0 2 0 0 0 2 0 0 0 2 1 0 0 1 1 0 0 1 0 0 0 1 1 0 1 0 1 1";
    const TemporaryFolder folder;
    const auto read = [&](int type, const std::string& points, int count) {
        return readMesh(folder.write("a.vtu", file(type, points, count)));
    };
    EXPECT_NEAR(totalVolume(read(12, hexahedron, 20).mesh), 8.0, 1e-13);
    EXPECT_EQ(read(12, hexahedron, 20).report.cellTypes.count("quadratic hexahedron"), 1u);
    EXPECT_NEAR(totalVolume(read(10, tetrahedron, 10).mesh), 8.0 / 6.0, 1e-13);
    EXPECT_NEAR(totalVolume(read(24, tetrahedron.substr(0, 23), 4).mesh), 8.0 / 6.0, 1e-13);
    EXPECT_NEAR(totalVolume(read(29, hexahedron, 20).mesh), 8.0, 1e-13);
    expectError([&] { read(12, hexahedron.substr(0, 53), 9); }, "1 unsupported cell (hexahedron)");
}

TEST(Dialects, EnsightNamesInQuotes) {
    const TemporaryFolder folder;
    const SmallMesh small = smallMesh("a.case");
    folder.write("my mesh.geo", small.files[1].content);
    folder.write("a.s", small.files[2].content);
    const ReadResult result = readMesh(folder.write(
        "the case.case",
        "FORMAT\ntype: ensight gold\n\nGEOMETRY\nmodel: \"my mesh.geo\"\n\nVARIABLE\nscalar per node: s \"a.s\"\n"));
    EXPECT_NEAR(totalVolume(result.mesh), smallMeshVolume, 1e-7);
    EXPECT_LT(largestError(result.mesh, smallMeshField), 1e-6);
    folder.write("e", "");  // a file whose name is only part of the case's words is none of it
    EXPECT_NEAR(totalVolume(readMesh(folder.file("the case.case")).mesh), smallMeshVolume, 1e-7);
    // Whatever is wrong is said of the files that are there.
    std::filesystem::remove(folder.file("a.s"));
    const std::string text = errorOf([&] { readMesh(folder.file("the case.case")); });
    EXPECT_NE(text.find(folder.file("a.s")), std::string::npos) << text;
}

TEST(Dialects, EnsightSectionsThatNobodyKnowsAreRefusedAtOnce) {
    const TemporaryFolder folder;
    const SmallMesh small = smallMesh("a.case");
    folder.write("a.geo", small.files[1].content);
    const std::string file = folder.write("a.case", "FORMAT\ntype: ensight gold\n\nGEOMETRY\nmodel: \"a.geo\"\n\nVa");
    expectError([&] { readMesh(file); }, "line 7: \"Va\" is no section");
}

/// Where the middle of each edge stands among the last six points is left to the file.
TEST(Dialects, TetgenOfOrderTwo) {
    const TemporaryFolder folder;
    const auto square = [](double x, double y, double z) { return x * x + 2.0 * y * y - z * z + x * y; };
    std::string nodes = "10 3 1 1\n";  // boundary markers, which are not there: their writer forgot
    int number = 0;
    for (const auto& [x, y, z] : std::vector<std::array<double, 3>>{{0, 0, 0},
                                                                    {2, 0, 0},
                                                                    {0, 2, 0},
                                                                    {0, 0, 2},
                                                                    {0, 1, 1},
                                                                    {1, 0, 1},
                                                                    {0, 0, 1},
                                                                    {1, 1, 0},
                                                                    {0, 1, 0},
                                                                    {1, 0, 0}}) {
        nodes += fmt::format("{} {} {} {} {}\n", ++number, x, y, z, square(x, y, z));
    }
    folder.write("a.node", nodes);
    const ReadResult result = readMesh(folder.write("a.ele", "1 10 0\n1 1 2 3 4 5 6 7 8 9 10\n"), inPieces(5));
    EXPECT_NEAR(totalVolume(result.mesh), 8.0 / 6.0, 1e-13);
    EXPECT_LT(largestError(result.mesh, [&](const glm::dvec3& x) { return square(x.x, x.y, x.z); }), 1e-12);
}

TEST(Dialects, SlicesThatAreNotThereAreNamedAtOnce) {
    const TemporaryFolder folder;
    const auto image = [&](const std::string& files) {
        return folder.write(
            "a.mhd",
            "ObjectType = Image\nNDims = 3\nDimSize = 2 2 3\nElementType = MET_UCHAR\nElementDataFile = " + files);
    };
    folder.write("s1.raw", "abcd");
    folder.write("s3.raw", "abcd");
    expectError([&] { readMesh(image("LIST\ns1.raw\ns2.raw\ns3.raw\n")); }, "a.mhd: names s2.raw, which is not there");
    expectError([&] { readMesh(image("s%d.raw 1 4 1\n")); }, "a.mhd: names s4.raw, which is not there");
    expectError([&] { readMesh(image("gone.raw\n")); }, "a.mhd: names gone.raw, which is not there");
}

/// Two cubes, a processor each, whose case keeps only the control files.
TEST(Dialects, DecomposedOpenFoam) {
    const TemporaryFolder folder;
    const auto write = [&](const std::string& name, const std::string& kind, const std::string& content) {
        std::filesystem::create_directories(std::filesystem::path(folder.file(name)).parent_path());
        folder.write(name, fmt::format("FoamFile {{ version 2.0; format ascii; class {}; object {}; }}\n{}\n", kind,
                                       std::filesystem::path(name).filename().string(), content));
    };
    write("system/controlDict", "dictionary",
          "startFrom startTime; startTime 0; endTime 1; deltaT 1; writeControl timeStep; writeInterval 1; "
          "timePrecision 6;");
    for (int processor = 0; processor < 2; ++processor) {
        const std::string root = fmt::format("processor{}/", processor);
        std::string points = "8\n(\n";
        for (int i = 0; i < 8; ++i) {
            points += fmt::format("({} {} {})\n", (i & 1) + processor, i >> 1 & 1, i >> 2);
        }
        write(root + "constant/polyMesh/points", "vectorField", points + ")");
        write(root + "constant/polyMesh/faces", "faceList",
              "6\n(\n4(0 4 6 2)\n4(1 3 7 5)\n4(0 1 5 4)\n4(2 6 7 3)\n4(0 2 3 1)\n4(4 5 7 6)\n)");
        write(root + "constant/polyMesh/owner", "labelList", "6\n(\n0\n0\n0\n0\n0\n0\n)");
        write(root + "constant/polyMesh/neighbour", "labelList", "0\n(\n)");
        write(root + "constant/polyMesh/boundary", "polyBoundaryMesh",
              "1\n(\nwalls { type wall; nFaces 6; startFace 0; }\n)");
        write(root + "0/T", "volScalarField",
              fmt::format("dimensions [0 0 0 1 0 0 0];\ninternalField nonuniform List<scalar> 1\n(\n{}\n);\n"
                          "boundaryField {{ walls {{ type zeroGradient; }} }}",
                          300 + 100 * processor));
    }
    for (const std::string& source : {folder.write("case.foam", "any"), folder.file(".")}) {
        const ReadResult result = readMesh(source);
        EXPECT_NEAR(totalVolume(result.mesh), 2.0, 1e-14);
        ASSERT_FALSE(result.mesh.fields.empty());
        EXPECT_EQ(result.mesh.fields[0].values.front(), 300.0);
        EXPECT_EQ(result.mesh.fields[0].values.back(), 400.0);
        EXPECT_EQ(result.report.notes.size(), 1u);
    }
}

}  // namespace
}  // namespace tetralux::mesh
