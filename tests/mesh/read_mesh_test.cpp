// SPDX-License-Identifier: Apache-2.0
#include <mesh/io/read_mesh.h>

#include <mesh/io/write_vtu.h>
#include <mesh/tet/procedural_field.h>

#include <fmt/format.h>

#include "mesh_checks.h"

namespace tetralux::mesh {
namespace {

using namespace test;

TetMesh meshWithFields() {
    TetMesh mesh = sampleOnGrid(proceduralField("hydrogen", 6), 6);
    mesh.fields.push_back(
        {"velocity <m/s> & \"more\"", Association::Point, 3, std::vector<double>(3 * mesh.positions.size())});
    std::iota(mesh.fields[1].values.begin(), mesh.fields[1].values.end(), -1e-3);
    mesh.fields.push_back({"größe", Association::Cell, 1, std::vector<double>(mesh.cells.size(), 1e300)});
    return mesh;
}

void expectSame(const TetMesh& a, const TetMesh& b) {
    EXPECT_EQ(a.positions, b.positions);
    EXPECT_EQ(a.cells, b.cells);
    ASSERT_EQ(a.fields.size(), b.fields.size());
    for (std::size_t i = 0; i < a.fields.size(); ++i) {
        EXPECT_EQ(a.fields[i].name, b.fields[i].name);
        EXPECT_EQ(a.fields[i].association, b.fields[i].association);
        EXPECT_EQ(a.fields[i].components, b.fields[i].components);
        EXPECT_EQ(a.fields[i].values, b.fields[i].values);
    }
}

TEST(WriteVtu, ComesBackToTheBit) {
    const TemporaryFolder folder;
    const TetMesh mesh = meshWithFields();
    writeVtu(folder.file("a.vtu"), mesh);
    const ReadResult result = readMesh(folder.file("a.vtu"));
    expectSame(result.mesh, mesh);
    EXPECT_TRUE(result.report.defects.empty());
    EXPECT_EQ(
        std::distance(std::filesystem::directory_iterator(std::filesystem::path(folder.file("")).parent_path()), {}),
        1);
}

TEST(WriteVtu, UnwritablePathIsNamed) {
    expectError([] { writeVtu("/nowhere/at/all.vtu", meshWithFields()); }, "/nowhere/at/all.vtu: cannot be written");
    const TemporaryFolder folder;
    std::filesystem::create_directories(folder.file("b.vtu") + "/full");
    expectError([&] { writeVtu(folder.file("b.vtu"), meshWithFields()); }, "cannot be replaced");
    EXPECT_EQ(
        std::distance(std::filesystem::directory_iterator(std::filesystem::path(folder.file("")).parent_path()), {}),
        1);
}

TEST(ReadMesh, GeneratedFieldsByName) {
    const ReadResult result = readMesh("marschner-lobb:5");
    EXPECT_EQ(result.mesh.cells.size(), 320u);
    EXPECT_EQ(result.report.cellsRead, 320u);
}

TEST(ReadMesh, SourcesThatCannotBeRead) {
    const TemporaryFolder folder;
    const auto reading = [](const std::string& source) { return [source] { readMesh(source); }; };
    expectError(reading(folder.file("no.vtu")), "no.vtu: no such file");
    expectError(reading(folder.file("no.xyz")), "no.xyz: no such file");
    expectError(reading(folder.file("")), "is a directory");
    expectError(reading(folder.write("zero.vtu", "")), "zero.vtu: is empty");
    expectError(reading(folder.write("a.abc", "1 2 3")), "a.abc: unknown kind of mesh; give one of VTK XML");
    expectError(reading("bucky:1"), "2 to 1000");
}

constexpr const char* vtuHead =
    "<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" byte_order=\"LittleEndian\"><UnstructuredGrid>";
constexpr const char* vtuTail = "</UnstructuredGrid></VTKFile>";

std::string vtu(const std::string& points, const std::string& connectivity, const std::string& offsets,
                const std::string& types, int pointCount, int cellCount) {
    return fmt::format(
        "{}<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\"><Points><DataArray type=\"Float64\" "
        "NumberOfComponents=\"3\" "
        "format=\"ascii\">{}</DataArray></Points><Cells><DataArray type=\"Int64\" Name=\"connectivity\" "
        "format=\"ascii\">{}</DataArray>"
        "<DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">{}</DataArray><DataArray type=\"UInt8\" "
        "Name=\"types\" "
        "format=\"ascii\">{}</DataArray></Cells></Piece>{}",
        vtuHead, pointCount, cellCount, points, connectivity, offsets, types, vtuTail);
}

struct InvalidFile {
    const char* name;
    std::string content;
    const char* message;
};

TEST(ReadVtk, InvalidFilesSayWhatIsWrong) {
    const std::string square = "0 0 0 1 0 0 0 1 0 0 0 1";
    const std::vector<InvalidFile> files{
        {"noise.vtu", "\x01\x02\x03 nothing", "noise.vtu: cannot be read"},
        {"open.vtu", std::string(vtuHead) + "<Piece NumberOf", "open.vtu: cannot be read"},
        {"empty.vtu", vtu("", "", "", "", 0, 0), "empty.vtu: holds no cells"},
        {"nocells.vtu", vtu(square, "", "", "", 4, 0), "nocells.vtu: holds no cells"},
        {"flat.vtu", vtu("0 0 0 1 0 0 0 1 0 1 1 0", "0 1 2 3", "4", "10", 4, 1),
         "no solid cell is left of 1: 1 flat cell"},
        {"far.vtu", vtu(square, "0 1 2 9", "4", "10", 4, 1), "1 index out of range"},
        {"type.vtu", vtu(square, "0 1 2 3", "4", "99", 4, 1), "1 unsupported cell"},
        {"surface.vtu", vtu(square, "0 1 2", "3", "5", 4, 1), "tetralux mesh"},
        {"noise.vtk", "# vtk DataFile Version 3.0\nx\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS four float\n",
         "noise.vtk: cannot be read"},
        {"other.vtk", "hello\n", "other.vtk: cannot be read"},
        {"none.pvd", "<VTKFile type=\"Collection\"><Collection/></VTKFile>", "none.pvd: names no file"},
        {"missing.pvd",
         "<VTKFile type=\"Collection\"><Collection><DataSet timestep=\"0\" file=\"gone.vtu\"/></Collection></VTKFile>",
         "missing.pvd: names gone.vtu, which is not there"},
        {"text.ex2", "not NetCDF", "text.ex2: does not begin as an Exodus file"},
        {"text.cgns", "not HDF5", "text.cgns: does not begin as a CGNS file"},
        {"thin.vti",
         "<VTKFile type=\"ImageData\" version=\"0.1\"><ImageData WholeExtent=\"0 4 0 4 0 0\" Origin=\"0 0 0\" "
         "Spacing=\"1 1 1\"><Piece "
         "Extent=\"0 4 0 4 0 0\"></Piece></ImageData></VTKFile>",
         "thin.vti: a grid of 5 x 5 x 1 points has no volume"},
    };
    const TemporaryFolder folder;
    for (const InvalidFile& file : files) {
        const std::string path = folder.write(file.name, file.content);
        expectError([&] { readMesh(path); }, file.message);
        expectError([&] { readMesh(path, isolatedReading()); }, file.message);
    }
}

#ifdef __has_feature
#define TETRALUX_HAS_FEATURE(feature) __has_feature(feature)
#else
#define TETRALUX_HAS_FEATURE(feature) 0
#endif
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__) && !TETRALUX_HAS_FEATURE(address_sanitizer) && \
    !TETRALUX_HAS_FEATURE(thread_sanitizer) && !TETRALUX_HAS_FEATURE(memory_sanitizer)  // with these it has no limit
/// 216 million points in a file of a few hundred bytes, which holds no value for any of them.
TEST(ReadVtk, SmallFilesGetLittleMemory) {
    const TemporaryFolder folder;
    const std::string path = folder.write(
        "vast.vti",
        "<VTKFile type=\"ImageData\" version=\"0.1\"><ImageData WholeExtent=\"0 599 0 599 0 599\" Origin=\"0 0 0\" "
        "Spacing=\"1 1 1\"><Piece Extent=\"0 599 0 599 0 599\"></Piece></ImageData></VTKFile>");
    expectError([&] { readMesh(path, isolatedReading()); },
                "vast.vti: asks for more memory than a file of its size can need");
}
#endif

TEST(ReadVtk, TruncatedAnywhereIsAnErrorOrWhole) {
    const TemporaryFolder folder;
    writeVtu(folder.file("a.vtu"), sampleOnGrid(proceduralField("coulomb", 3), 3));
    std::ifstream in(folder.file("a.vtu"), std::ios::binary);
    const std::string whole((std::istreambuf_iterator<char>(in)), {});
    for (std::size_t size = 1; size + 40 < whole.size(); size += whole.size() / 40) {
        const std::string path = folder.write("cut.vtu", whole.substr(0, size));
        expectError([&] { readMesh(path, isolatedReading()); }, "cut.vtu: ");
    }
}

/// Damage of every kind, with printed seed: each copy is read or refused, in one line, and nothing else happens.
TEST(ReadVtk, DamagedCopiesNeitherCrashNorHang) {
    const TemporaryFolder folder;
    writeVtu(folder.file("a.vtu"), sampleOnGrid(proceduralField("coulomb", 3), 3));
    std::ifstream in(folder.file("a.vtu"), std::ios::binary);
    const std::string whole((std::istreambuf_iterator<char>(in)), {});
    constexpr unsigned seed = 20260722;
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    for (int copy = 0; copy < 100; ++copy) {
        std::string damaged = whole;
        for (int flip = 0; flip < 3; ++flip) {
            damaged[random() % damaged.size()] ^= static_cast<char>(1u << random() % 8);
        }
        const std::string path = folder.write("damaged.vtu", damaged);
        try {
            const ReadResult result = readMesh(path, isolatedReading());
            EXPECT_FALSE(result.mesh.cells.empty());
        } catch (const std::runtime_error& error) {
            EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
        }
    }
}

TEST(ReadVtk, GhostsSeriesAndPiecesTogether) {
    const TemporaryFolder folder;
    TetMesh left = sampleOnGrid(proceduralField("coulomb", 3), 3);
    TetMesh right = left;
    left.fields = {{"s", Association::Point, 1, {}}};
    for (glm::dvec3& x : right.positions) {
        x.x = 2.0 - x.x;  // mirrored, so that the diagonals of the common face fit
    }
    right.fields = left.fields;
    for (TetMesh* half : {&left, &right}) {
        for (const glm::dvec3& x : half->positions) {
            half->fields[0].values.push_back(linearField(x));
        }
    }
    writeVtu(folder.file("left.vtu"), left);
    writeVtu(folder.file("right.vtu"), right);
    const std::string series =
        folder.write("both.pvd",
                     "<VTKFile type=\"Collection\"><Collection><DataSet timestep=\"0\" file=\"left.vtu\"/>"
                     "<DataSet timestep=\"2.5\" part=\"0\" file=\"left.vtu\"/><DataSet timestep=\"2.5\" part=\"1\" "
                     "file=\"right.vtu\"/></Collection></VTKFile>");
    ReadOptions options;
    EXPECT_EQ(readMesh(series, options).mesh.cells.size(), 40u);
    options.time = 2.0;
    const ReadResult both = readMesh(series, options);
    EXPECT_EQ(both.times, (std::vector<double>{0.0, 2.5}));
    EXPECT_EQ(both.mesh.cells.size(), 80u);
    EXPECT_EQ(both.mesh.positions.size(), 45u);  // 27 + 27 less the 9 of the common face
    EXPECT_EQ(countOf(both.report, Defect::InvertedCell), 40u);
    EXPECT_NEAR(totalVolume(both.mesh), 2.0, 1e-14);
}

TEST(ReadVtk, ImagesRectilinearAndStructuredGrids) {
    const TemporaryFolder folder;
    const std::string values = "0 1 2 3 4 5 6 7";
    const std::string array =
        "<PointData><DataArray type=\"Float32\" Name=\"v\" format=\"ascii\">" + values + "</DataArray></PointData>";
    const std::string image = folder.write("a.vti",
                                           "<VTKFile type=\"ImageData\" version=\"0.1\"><ImageData WholeExtent=\"0 1 0 "
                                           "1 0 1\" Origin=\"1 2 3\" Spacing=\"2 1 1\"><Piece "
                                           "Extent=\"0 1 0 1 0 1\">" +
                                               array + "</Piece></ImageData></VTKFile>");
    const ReadResult voxels = readMesh(image);
    EXPECT_NEAR(totalVolume(voxels.mesh), 2.0, 1e-15);
    EXPECT_EQ(voxels.report.cellTypes.at("voxel"), 1u);
    EXPECT_LT(
        largestError(voxels.mesh, [](const glm::dvec3& x) { return (x.x - 1) / 2 + 2 * (x.y - 2) + 4 * (x.z - 3); }),
        1e-15);
    const std::string grid =
        folder.write("b.vtk",
                     "# vtk DataFile Version 3.0\nx\nASCII\nDATASET STRUCTURED_GRID\nDIMENSIONS 2 2 2\nPOINTS 8 "
                     "float\n0 0 0 1 0 0 0 1 0 1 1 0 "
                     "0 0 1 1 0 1 0 1 1 1 1 1\nPOINT_DATA 8\nSCALARS v float 1\nLOOKUP_TABLE default\n" +
                         values + "\n");
    const ReadResult hexahedron = readMesh(grid);
    EXPECT_EQ(hexahedron.report.cellTypes.at("hexahedron"), 1u);
    EXPECT_NEAR(totalVolume(hexahedron.mesh), 1.0, 1e-15);
    const std::string lines = folder.write(
        "c.vtk",
        "# vtk DataFile Version 3.0\nx\nASCII\nDATASET RECTILINEAR_GRID\nDIMENSIONS 2 2 3\nX_COORDINATES 2 float\n0 "
        "1\nY_COORDINATES 2 "
        "float\n0 1\nZ_COORDINATES 3 float\n0 1 5\nCELL_DATA 2\nSCALARS c float 1\nLOOKUP_TABLE default\n1 2\n");
    EXPECT_NEAR(totalVolume(readMesh(lines).mesh), 5.0, 1e-15);
}

/// Two cubes side by side, with a temperature in each, as OpenFOAM keeps them.
TEST(ReadVtk, OpenFoamCaseByFolderOrFile) {
    const TemporaryFolder folder;
    for (const char* part : {"system", "constant/polyMesh", "0"}) {
        std::filesystem::create_directories(folder.file(part));
    }
    const auto write = [&](const std::string& name, const std::string& kind, const std::string& content) {
        const std::string object = std::filesystem::path(name).filename().string();
        folder.write(name, fmt::format("FoamFile {{ version 2.0; format ascii; class {}; object {}; }}\n{}\n", kind,
                                       object, content));
    };
    write("system/controlDict", "dictionary",
          "startFrom startTime; startTime 0; endTime 1; deltaT 1; writeControl timeStep; writeInterval 1; "
          "timePrecision 6;");
    write("constant/polyMesh/points", "vectorField",
          "12\n(\n(0 0 0)\n(1 0 0)\n(2 0 0)\n(0 1 0)\n(1 1 0)\n(2 1 0)\n(0 0 1)\n(1 0 1)\n(2 0 1)\n(0 1 1)\n(1 1 1)\n"
          "(2 1 1)\n)");
    write("constant/polyMesh/faces", "faceList",
          "11\n(\n4(1 4 10 7)\n4(0 6 9 3)\n4(0 1 7 6)\n4(3 9 10 4)\n4(0 3 4 1)\n4(6 7 10 9)\n4(2 5 11 8)\n4(1 2 8 7)\n"
          "4(4 10 11 5)\n4(1 4 5 2)\n4(7 8 11 10)\n)");
    write("constant/polyMesh/owner", "labelList", "11\n(\n0\n0\n0\n0\n0\n0\n1\n1\n1\n1\n1\n)");
    write("constant/polyMesh/neighbour", "labelList", "1\n(\n1\n)");
    write("constant/polyMesh/boundary", "polyBoundaryMesh", "1\n(\nwalls { type wall; nFaces 10; startFace 1; }\n)");
    write("0/T", "volScalarField",
          "dimensions [0 0 0 1 0 0 0];\ninternalField nonuniform List<scalar> 2\n(\n300\n400\n);\n"
          "boundaryField { walls { type zeroGradient; } }");
    for (const std::string& source :
         {folder.write("case.foam", "any"), folder.file("."), folder.file("system/controlDict")}) {
        const ReadResult result = readMesh(source);
        EXPECT_EQ(result.mesh.cells.size(), 12u) << source;
        EXPECT_NEAR(totalVolume(result.mesh), 2.0, 1e-14);
        EXPECT_EQ(result.mesh.fields.at(0).name, "T");
        EXPECT_EQ(result.mesh.fields[0].values.front(), 300.0);
        EXPECT_EQ(result.mesh.fields[0].values.back(), 400.0);
    }
}

TEST(ReadRaw, SizeFromTheNameOrBehindIt) {
    const TemporaryFolder folder;
    std::string bytes(24, '\0');  // 2 × 3 × 4
    for (std::size_t i = 0; i < bytes.size(); ++i) {
        bytes[i] = static_cast<char>(10 * i);
    }
    const ReadResult named = readMesh(folder.write("head_2x3x4_uint8.raw", bytes));
    EXPECT_NEAR(totalVolume(named.mesh), 6.0, 1e-14);
    EXPECT_EQ(named.mesh.fields[0].values.back(), 230.0);
    EXPECT_EQ(readMesh(folder.write("plain.raw", bytes) + ":2x3x2:uint16").mesh.fields[0].values[1],
              20.0 + 256.0 * 30.0);
    EXPECT_EQ(readMesh(folder.write("guess_2x3x2.raw", bytes)).mesh.positions.size(), 12u);
    expectError([&] { readMesh(folder.file("plain.raw")); }, "put it behind the name");
    expectError([&] { readMesh(folder.file("plain.raw") + ":2x3x9:uint8"); }, "54");
    expectError([&] { readMesh(folder.file("plain.raw") + ":999999x999999x999999:uint8"); }, "plain.raw: ");
    expectError([&] { readMesh(folder.file("plain.raw") + ":2x3x4:uint7"); }, "fits no type");
}

}  // namespace
}  // namespace tetralux::mesh
