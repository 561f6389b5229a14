// SPDX-License-Identifier: Apache-2.0
//
// One mesh in every kind of file, whole and damaged, and the files that nothing reads.
#include <functional>

#include "damage.h"
#include "small_files.h"

namespace tetralux::mesh {
namespace {

using namespace test;

TEST(Formats, OneMeshFromEveryKindOfFile) {
    for (const SmallMesh& small : smallMeshes()) {
        SCOPED_TRACE(small.source);
        const TemporaryFolder folder;
        ReadResult result = readMesh(written(small, folder));
        EXPECT_EQ(result.mesh.cells.size(), 2u);
        EXPECT_NEAR(totalVolume(result.mesh), smallMeshVolume, 1e-7);
        EXPECT_TRUE(result.report.defects.empty());
        if (small.hasValues) {
            const auto onPoints = [](const Field& field) { return field.association == Association::Point; };
            std::erase_if(result.mesh.fields, std::not_fn(onPoints));  // regions and materials
            ASSERT_EQ(result.mesh.fields.size(), 1u);
            EXPECT_LT(largestError(result.mesh, smallMeshField), 1e-6);
        }
    }
}

/// The short form of read_damaged, of one file of each kind: a crash ends this test, a hang its time limit.
TEST(Formats, DamagedCopiesAreReadOrRefused) {
    constexpr std::uint64_t seeds = 4;
    for (const SmallMesh& small : smallMeshes()) {
        const TemporaryFolder folder;
        const std::string source = written(small, folder);
        for (const SmallFile& file : small.files) {
            for (const Damage damage : damages) {
                for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
                    writeFile(folder.file(file.name), damagedCopy(file.content, damage, seed));
                    const ReadingEnd end = readAll(source);
                    EXPECT_TRUE(end == ReadingEnd::Mesh || end == ReadingEnd::Refusal)
                        << file.name << ", " << damageName(damage) << ", seed " << seed;
                }
            }
            folder.write(file.name, file.content);
        }
    }
}

/// Packed by gzip itself, so that nothing here is both writer and reader.
TEST(Formats, PackedByGzip) {
    const auto packed = [](const std::string& file) { return std::system(("gzip -nf " + file).c_str()) == 0; };
    for (const SmallMesh& small : smallMeshes()) {
        if (std::filesystem::path(small.source).extension().empty() || small.source.find(':') != std::string::npos)
            continue;
        SCOPED_TRACE(small.source);
        const TemporaryFolder folder;
        const std::string source = written(small, folder);
        if (!std::filesystem::is_regular_file(source)) continue;
        ASSERT_TRUE(packed(source));
        const ReadResult result = readMesh(source + ".gz");
        EXPECT_EQ(result.mesh.cells.size(), 2u);
        EXPECT_NEAR(totalVolume(result.mesh), smallMeshVolume, 1e-7);

        std::ifstream in(source + ".gz", std::ios::binary);
        const std::string whole((std::istreambuf_iterator<char>(in)), {});
        for (const Damage damage : damages) {
            folder.write(std::filesystem::path(source + ".gz").filename(), damagedCopy(whole, damage, 1));
            const ReadingEnd end = readAll(source + ".gz");
            EXPECT_TRUE(end == ReadingEnd::Mesh || end == ReadingEnd::Refusal) << damageName(damage);
        }
    }
    const TemporaryFolder folder;
    expectError([&] { readMesh(folder.write("a.vtu.gz", "x")); }, "a.vtu.gz: does not begin as a file of gzip");
    expectError([&] { readMesh(folder.write("a.vtu.gz", "\x1f\x8b\x08")); }, "a.vtu.gz: cannot be unpacked");
    expectError([&] { readMesh(folder.write("a.xyz9.gz", "x")); }, "unknown kind of mesh");
}

/// Two cubes in a row, x + 2 y + 3 z on points and 5, 7 on cells: the smallest file that HDF5 1.10 writes of them.
TEST(Formats, VtkHdf) {
    const std::filesystem::path whole = std::filesystem::path(TETRALUX_TEST_DATA) / "cubes.vtkhdf";
    const ReadResult result = readMesh(whole.string());
    EXPECT_TRUE(result.report.defects.empty());
    EXPECT_EQ(result.report.cellTypes.at("hexahedron"), 2u);
    EXPECT_NEAR(totalVolume(result.mesh), 2.0, 1e-14);
    ASSERT_EQ(result.mesh.fields.size(), 2u);
    for (const Field& field : result.mesh.fields) {
        for (std::size_t i = 0; i < field.values.size(); ++i) {
            if (field.association == Association::Point) {
                const glm::dvec3 x = result.mesh.positions[i];
                EXPECT_NEAR(field.values[i], x.x + 2.0 * x.y + 3.0 * x.z, 1e-14);
            } else {
                EXPECT_EQ(field.values[i], i < 6 ? 5.0 : 7.0);
            }
        }
    }
    const TemporaryFolder folder;
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
        for (const Damage damage : damages) {
            writeFile(folder.file("a.vtkhdf"), damagedCopy(wholeFile(whole), damage, seed));
            const ReadingEnd end = readAll(folder.file("a.vtkhdf"));
            EXPECT_TRUE(end == ReadingEnd::Mesh || end == ReadingEnd::Refusal) << damageName(damage) << ' ' << seed;
        }
    }
}

/// As VTK writes a part without cells: neither points nor fields, which it then misses itself.
TEST(Formats, EmptyPiecesAreNoFault) {
    const TemporaryFolder folder;
    folder.write("a.vtu", smallVtu());
    const std::string empty =
        folder.write("empty.vtu",
                     "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\"><UnstructuredGrid><Piece NumberOfPoints=\"0\" "
                     "NumberOfCells=\"0\"><PointData></PointData><CellData></CellData><Points></Points><Cells>"
                     "<DataArray type=\"Int64\" Name=\"connectivity\" format=\"ascii\"></DataArray>"
                     "<DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\"></DataArray>"
                     "<DataArray type=\"UInt8\" Name=\"types\" format=\"ascii\"></DataArray></Cells></Piece>"
                     "</UnstructuredGrid></VTKFile>");
    const auto pieces = [&](const std::string& first, const std::string& second) {
        return folder.write("a.pvtu", fmt::format("<VTKFile type=\"PUnstructuredGrid\"><PUnstructuredGrid>"
                                                  "<PPointData><PDataArray type=\"Float64\" Name=\"s\"/></PPointData>"
                                                  "<Piece Source=\"{}\"/><Piece Source=\"{}\"/></PUnstructuredGrid>"
                                                  "</VTKFile>",
                                                  first, second));
    };
    for (const std::string& source : {pieces("a.vtu", "empty.vtu"), pieces("empty.vtu", "a.vtu")}) {
        const ReadResult result = readMesh(source);
        EXPECT_EQ(result.mesh.cells.size(), 2u);
        EXPECT_LT(largestError(result.mesh, smallMeshField), 1e-6);
        EXPECT_TRUE(result.times.empty());
    }
    const ReadResult series = readMesh(folder.write(
        "a.pvd",
        "<VTKFile type=\"Collection\"><Collection><DataSet timestep=\"3\" file=\"a.pvtu\"/></Collection></VTKFile>"));
    EXPECT_EQ(series.mesh.cells.size(), 2u);
    EXPECT_EQ(series.times, std::vector<double>{3.0});
    expectError([&] { readMesh(empty); }, "empty.vtu: holds no cells");
    expectError([&] { readMesh(pieces("a.vtu", "gone.vtu")); }, "a.pvtu: names gone.vtu, which is not there");
    expectError([&] { readMesh(folder.write("b.pvtu", smallVtu())); }, "b.pvtu: is no mesh in pieces");
}

TEST(Formats, BitsAreNumbers) {
    const TemporaryFolder folder;
    const std::string path =
        folder.write("bits.vtk",
                     "# vtk DataFile Version 3.0\nx\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 4 float\n0 0 0 1 0 0 0 1 "
                     "0 0 0 1\nCELLS 1 5\n4 0 1 2 3\nCELL_TYPES 1\n10\nPOINT_DATA 4\nSCALARS inside bit 1\n"
                     "LOOKUP_TABLE default\n0 1 1 0\n");
    EXPECT_EQ(readMesh(path).mesh.fields.at(0).values, (std::vector<double>{0.0, 1.0, 1.0, 0.0}));
}

/// A cube of two cells along each edge, one of which is refined once more: it is hidden under its eight.
TEST(Formats, RefinedCellsOfAmrAreNotDrawnTwice) {
    const TemporaryFolder folder;
    const auto image = [&](const std::string& name, double spacing) {
        folder.write(name,
                     fmt::format("<VTKFile type=\"ImageData\" version=\"2.2\"><ImageData WholeExtent=\"0 2 0 2 0 2\" "
                                 "Origin=\"0 0 0\" Spacing=\"{0} {0} {0}\"><Piece Extent=\"0 2 0 2 0 2\"><CellData>"
                                 "<DataArray type=\"Float64\" Name=\"c\" format=\"ascii\">1 2 3 4 5 6 7 8</DataArray>"
                                 "</CellData></Piece></ImageData></VTKFile>",
                                 spacing));
    };
    image("coarse.vti", 1.0);
    image("fine.vti", 0.5);
    const std::string amr = folder.write("a.vth",
                                         "<VTKFile type=\"vtkOverlappingAMR\" version=\"1.1\"><vtkOverlappingAMR "
                                         "origin=\"0 0 0\" grid_description=\"XYZ\">"
                                         "<Block level=\"0\" spacing=\"1 1 1\"><DataSet index=\"0\" amr_box=\"0 1 0 1 "
                                         "0 1\" file=\"coarse.vti\"/></Block>"
                                         "<Block level=\"1\" spacing=\"0.5 0.5 0.5\"><DataSet index=\"0\" amr_box=\"0 "
                                         "1 0 1 0 1\" file=\"fine.vti\"/></Block>"
                                         "</vtkOverlappingAMR></VTKFile>");
    const ReadResult result = readMesh(amr);
    EXPECT_EQ(countOf(result.report, Defect::HiddenCell), 1u);
    EXPECT_EQ(result.report.cellTypes.at("voxel"), 16u);
    EXPECT_NEAR(totalVolume(result.mesh), 8.0, 1e-12);
}

TEST(Formats, WhatIsNotReadSaysWhatToDo) {
    const TemporaryFolder folder;
    const auto reading = [&](const std::string& name, const std::string& content) {
        return [path = folder.write(name, content)] { readMesh(path); };
    };
    expectError(reading("a.stl", "solid"), "a.stl: is a surface; make tetrahedra of it with `tetralux mesh`");
    expectError(reading("a.csv", "x,y,z"), "a.csv: holds points; make tetrahedra");
    expectError(reading("a.htg", "<VTKFile"),
                "a.htg: is a hyper tree grid, which is not read; make a grid of its leaves");
    expectError(reading("a.vtt", "<VTKFile"), "a.vtt: is a table, which has no cells");
    expectError(reading("a.sol", "x"), "a.sol: holds the values of a MEDIT mesh; give the .mesh");
    expectError(reading("a.h5", "x"), "a.h5: is HDF5");
    expectError(reading("a.vtkhdf", "x"), "a.vtkhdf: does not begin as a VTKHDF file");
    expectError(reading("a.msh", "(0 \"Fluent\")\n"), "is a mesh of ANSYS Fluent");
    expectError(reading("a.cas", "no parenthesis"), "a.cas: does not begin as a case of ANSYS Fluent");
    expectError(reading("a.xyz9", "x"), "a.xyz9: unknown kind of mesh; give one of VTK XML");
}

/// A stand-in for meshio, as it may not be installed: what is asked of it, and what becomes of its answers.
TEST(Formats, ByMeshio) {
    const TemporaryFolder folder, modules;
    const auto install = [&](const std::string& text) { modules.write("meshio.py", text); };
    ::setenv("PYTHONPATH", modules.file("").c_str(), 1);
    ::setenv("PYTHONDONTWRITEBYTECODE", "1", 1);
    const std::string mesh = folder.write("a.su2", "a mesh"), abaqus = folder.write("a.inp", "*HEADING\n*NODE\n");
    const std::string reads =
        "class Mesh: cell_sets = {}\n"
        "def read(path):\n"
        "    if 'broken' in open(path).read(): raise ValueError('no\\nelements')\n"
        "    return Mesh()\n"
        "def write(path, mesh, file_format): open(path, 'w').write(";
    install(reads + "'''" + smallVtu() + "''')\n");
    for (const std::string& source : {mesh, abaqus}) {
        const ReadResult result = readMesh(source);
        EXPECT_EQ(result.mesh.cells.size(), 2u);
        EXPECT_LT(largestError(result.mesh, smallMeshField), 1e-6);
    }
    expectError([&] { readMesh(folder.write("b.su2", "broken")); },
                "b.su2: meshio cannot read it: no elements; write it again");
    install(reads + "'<VTKFile')\n");
    expectError([&] { readMesh(mesh); }, "a.su2: by meshio: ");
    install("def read(path): raise SystemExit('bye')");
    expectError([&] { readMesh(mesh); }, "a.su2: meshio cannot read it: bye");
    install("import os\nos._exit(9)");
    expectError([&] { readMesh(mesh); }, "a.su2: is read by meshio: python3: ended with status 9");
    install("raise ImportError");
    expectError([&] { readMesh(mesh); }, "a.su2: is read by meshio, which python3 does not find; install it");
    ::unsetenv("PYTHONPATH");
}

/// Cells that have the number of points of a uniform order but are not of one, and weights that change the shape.
TEST(Formats, OrdersAndWeightsThatAreNotReadAreNamed) {
    const TemporaryFolder folder;
    const auto hexahedron = [&](const std::string& pointData, const std::string& cellData) {
        return folder.write(
            "h.vtu",
            "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\"><UnstructuredGrid><Piece NumberOfPoints=\"8\" "
            "NumberOfCells=\"1\">" +
                pointData + cellData +
                "<Points><DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">0 0 0 1 0 0 1 1 0 0 1 0 "
                "0 0 1 1 0 1 1 1 1 0 1 1</DataArray></Points><Cells><DataArray type=\"Int64\" Name=\"connectivity\" "
                "format=\"ascii\">0 1 2 3 4 5 6 7</DataArray><DataArray type=\"Int64\" Name=\"offsets\" "
                "format=\"ascii\">8</DataArray><DataArray type=\"UInt8\" Name=\"types\" "
                "format=\"ascii\">79</DataArray></Cells></Piece></UnstructuredGrid></VTKFile>");
    };
    const auto weights = [](const std::string& values) {
        return "<PointData RationalWeights=\"RationalWeights\"><DataArray type=\"Float64\" Name=\"RationalWeights\" "
               "format=\"ascii\">" +
               values + "</DataArray></PointData>";
    };
    const auto degrees = [](const std::string& values) {
        return "<CellData HigherOrderDegrees=\"HigherOrderDegrees\"><DataArray type=\"Float64\" "
               "NumberOfComponents=\"3\" Name=\"HigherOrderDegrees\" "
               "format=\"ascii\">" +
               values + "</DataArray></CellData>";
    };
    EXPECT_NEAR(totalVolume(readMesh(hexahedron(weights("1 1 1 1 1 1 1 1"), degrees("1 1 1"))).mesh), 1.0, 1e-14);
    expectError([&] { readMesh(hexahedron(weights("1 1 2 1 1 1 1 1"), "")); },
                "h.vtu: point 2 has a rational weight other than 1");
    expectError([&] { readMesh(hexahedron("", degrees("1 3 1"))); }, "h.vtu: cell 0 has a different order along each");
}

}  // namespace
}  // namespace tetralux::mesh
