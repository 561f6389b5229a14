// SPDX-License-Identifier: Apache-2.0
#include <mesh/io/parse_mesh.h>

#include <map>

#include <fmt/format.h>

#include <mesh/io/gmsh_elements.h>
#include <mesh/soup/shape_functions.h>
#include <mesh/soup/validation.h>

#include "mesh_checks.h"

namespace tetralux::mesh {
namespace {

using namespace test;

/// Bytes of numbers one behind the other, as a binary file has them.
template <class... Numbers>
std::string packed(Numbers... numbers) {
    std::string bytes;
    ((bytes.append(reinterpret_cast<const char*>(&numbers), sizeof numbers)), ...);
    return bytes;
}

const std::string gmsh2 =
    "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n3 7 \"rock\"\n$EndPhysicalNames\n"
    "$Nodes\n5\n10 0 0 0\n20 1 0 0\n30 0 1 0\n40 0 0 1\n50 1 1 1\n$EndNodes\n"
    "$Elements\n3\n1 2 2 0 1 10 20 30\n2 4 2 7 1 10 20 30 40\n5 4 2 7 2 20 30 40 50\n$EndElements\n"
    "$NodeData\n1\n\"heat\"\n1\n0.5\n3\n0\n1\n5\n10 1\n20 2\n30 3\n40 4\n50 5\n$EndNodeData\n"
    "$NodeData\n1\n\"heat\"\n1\n1.5\n3\n1\n1\n5\n10 11\n20 12\n30 13\n40 14\n50 15\n$EndNodeData\n"
    "$ElementData\n1\n\"flow\"\n1\n0.5\n3\n0\n3\n1\n5 1 2 3\n$EndElementData\n";

TEST(Gmsh, Version2TextWithData) {
    const CellSoup soup = parseGmsh(gmsh2, "a.msh", std::nullopt);
    EXPECT_EQ(soup.times, (std::vector<double>{0.5, 1.5}));
    const ReadResult result = tetMeshFromSoup(soup);
    EXPECT_NEAR(totalVolume(result.mesh), 1.0 / 6.0 + 1.0 / 3.0, 1e-15);
    ASSERT_EQ(result.mesh.fields.size(), 3u);
    EXPECT_EQ(result.mesh.fields[1].name, "heat");
    EXPECT_EQ(result.mesh.fields[1].values, (std::vector<double>{1, 2, 3, 4, 5}));
    EXPECT_EQ(result.mesh.fields[2].values[5], 3.0);
    EXPECT_TRUE(std::isnan(result.mesh.fields[2].values[0]));
    EXPECT_EQ(parseGmsh(gmsh2, "a.msh", 1.4).fields[1].values[0], 11.0);
}

TEST(Gmsh, PhysicalGroupsThatDiffer) {
    std::string groups = gmsh2;
    groups.replace(groups.find("5 4 2 7 2 "), 10, "5 4 2 9 2 ");
    const CellSoup soup = parseGmsh(groups, "a.msh", std::nullopt);
    const Field& physical = soup.fields.back();
    EXPECT_EQ(physical.name, "physical");
    EXPECT_FALSE(physical.bookkeeping);
    EXPECT_EQ(physical.values, (std::vector<double>{0, 7, 9}));
}

TEST(Gmsh, Version2Binary) {
    std::string bytes = "$MeshFormat\n2.2 1 8\n" + packed(1) + "\n$EndMeshFormat\n$Nodes\n4\n";
    bytes += packed(1, 0.0, 0.0, 0.0, 2, 1.0, 0.0, 0.0, 3, 0.0, 1.0, 0.0, 4, 0.0, 0.0, 1.0);
    bytes += "\n$EndNodes\n$Elements\n1\n" + packed(4, 1, 2, 9, 0, 0, 1, 2, 3, 4) + "\n$EndElements\n";
    EXPECT_NEAR(totalVolume(tetMeshFromSoup(parseGmsh(bytes, "b.msh", {})).mesh), 1.0 / 6.0, 1e-15);
}

TEST(Gmsh, Version41TextAndBinary) {
    const std::string text =
        "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n2 4 1 4\n2 1 1 1\n1\n0 0 0 .5 .5\n3 1 0 3\n2\n3\n4\n1 0 0\n0 1 "
        "0\n0 0 1\n$EndNodes\n"
        "$Elements\n1 1 1 1\n3 1 4 1\n1 1 2 3 4\n$EndElements\n";
    EXPECT_NEAR(totalVolume(tetMeshFromSoup(parseGmsh(text, "c.msh", {})).mesh), 1.0 / 6.0, 1e-15);
    using Size = std::uint64_t;
    std::string bytes = "$MeshFormat\n4.1 1 8\n" + packed(1) + "\n$EndMeshFormat\n$Nodes\n";
    bytes += packed(Size{1}, Size{4}, Size{1}, Size{4}, 3, 1, 0, Size{4}, Size{1}, Size{2}, Size{3}, Size{4});
    bytes += packed(0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0) + "\n$EndNodes\n$Elements\n";
    bytes += packed(Size{1}, Size{1}, Size{1}, Size{1}, 3, 1, 4, Size{1}, Size{1}, Size{1}, Size{2}, Size{3}, Size{4});
    bytes += "\n$EndElements\n";
    EXPECT_NEAR(totalVolume(tetMeshFromSoup(parseGmsh(bytes, "d.msh", {})).mesh), 1.0 / 6.0, 1e-15);
}

/// The order of Gmsh's second-order points is right if the points in the middle of Gmsh's edges (reference manual,
/// "Node ordering") land where VTK's shape functions expect them.
TEST(Gmsh, SecondOrderPointsAreInVtksOrder) {
    using Edges = std::vector<std::vector<int>>;
    const Edges hexEdges{{0, 1}, {0, 3}, {0, 4}, {1, 2}, {1, 5}, {2, 3},
                         {2, 6}, {3, 7}, {4, 5}, {4, 7}, {5, 6}, {6, 7}};
    Edges hex27 = hexEdges;
    for (const std::vector<int>& face : Edges{{0, 3, 2, 1},
                                              {0, 1, 5, 4},
                                              {0, 4, 7, 3},
                                              {1, 2, 6, 5},
                                              {2, 3, 7, 6},
                                              {4, 5, 6, 7},
                                              {0, 1, 2, 3, 4, 5, 6, 7}}) {
        hex27.push_back(face);
    }
    const Edges wedgeEdges{{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 4}, {2, 5}, {3, 4}, {3, 5}, {4, 5}};
    Edges wedge18 = wedgeEdges;
    for (const std::vector<int>& face : Edges{{0, 1, 4, 3}, {0, 2, 5, 3}, {1, 2, 5, 4}}) {
        wedge18.push_back(face);
    }
    const Edges pyramidEdges{{0, 1}, {0, 3}, {0, 4}, {1, 2}, {1, 4}, {2, 3}, {2, 4}, {3, 4}};
    struct Case {
        int type;
        std::vector<glm::dvec3> corners;
        Edges extra;
    };
    const std::vector<glm::dvec3> cube{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                                       {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
    const std::vector<glm::dvec3> prism{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}};
    const std::vector<Case> cases{
        {11, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 1}, {1, 2}, {0, 2}, {0, 3}, {2, 3}, {1, 3}}},
        {17, cube, hexEdges},
        {12, cube, hex27},
        {18, prism, wedgeEdges},
        {13, prism, wedge18},
        {19, {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}}, pyramidEdges}};
    for (const Case& one : cases) {
        CellSoup soup;
        soup.points = one.corners;
        for (const std::vector<int>& ids : one.extra) {
            glm::dvec3 sum(0.0);
            for (const int id : ids) {
                sum += one.corners[static_cast<std::size_t>(id)] / static_cast<double>(ids.size());
            }
            soup.points.push_back(sum);
        }
        const GmshElement element = gmshElement(one.type);
        ASSERT_EQ(static_cast<std::size_t>(element.points), soup.points.size());
        appendCell(soup, element.type, element.order);
        addPointField(soup, "s", linearField);
        ReadOptions options;
        options.subdivision =
            5;  // no lattice point but the corners is a point of the cell: all come from its shape functions
        const ReadResult result = tetMeshFromSoup(soup, options);
        EXPECT_LT(largestError(result.mesh, linearField), 1e-13) << one.type;
        CellSoup linear;
        linear.points = one.corners;
        const std::map<std::size_t, std::uint8_t> linearType{{4, 10}, {8, 12}, {6, 13}, {5, 14}};
        std::vector<int> ids(one.corners.size());
        std::iota(ids.begin(), ids.end(), 0);
        appendCell(linear, linearType.at(ids.size()), ids);
        EXPECT_NEAR(totalVolume(result.mesh), totalVolume(tetMeshFromSoup(linear).mesh), 1e-13) << one.type;
    }
}

const std::string medit =
    "MeshVersionFormatted 2\nDimension 3\n# a comment\nVertices\n5\n0 0 0 0\n1 0 0 0\n0 1 0 0\n0 0 1 0\n1 1 1 "
    "3\nTriangles\n1\n1 2 3 4\n"
    "Tetrahedra\n2\n1 2 3 4 7\n2 3 4 5 8\nRequiredVertices\n2\n1\n2\nEnd\n";

TEST(Medit, TextWithSolution) {
    CellSoup soup = parseMeditText(medit, "a.mesh");
    parseMeditSolution(
        "MeshVersionFormatted 2\nDimension 3\nSolAtVertices\n5\n2 1 2\n1 0 0 1\n2 0 0 2\n3 0 0 3\n4 0 0 4\n5 0 0 "
        "5\nEnd\n",
        "a.sol", soup);
    const ReadResult result = tetMeshFromSoup(soup);
    EXPECT_NEAR(totalVolume(result.mesh), 0.5, 1e-15);
    EXPECT_EQ(result.mesh.fields[0].values, (std::vector<double>{7, 8}));
    EXPECT_EQ(result.mesh.fields[1].values, (std::vector<double>{1, 2, 3, 4, 5}));
    EXPECT_EQ(result.mesh.fields[2].components, 3);
    expectError([&] { parseMeditSolution("SolAtVertices 2 1 1 0 0", "b.sol", soup); },
                "2 vertices where the mesh has 5");
}

TEST(Medit, BinaryOfEitherByteOrder) {
    std::string bytes = packed(1, 2) + packed(3, 20, 3);  // dimension at byte 8, next section at 20
    bytes += packed(4, 144, 4);                           // vertices: 12 + 4·28 bytes
    bytes += packed(0.0, 0.0, 0.0, 0) + packed(1.0, 0.0, 0.0, 0) + packed(0.0, 1.0, 0.0, 0) + packed(0.0, 0.0, 1.0, 0);
    bytes += packed(8, 176, 1, 1, 2, 3, 4, 5) + packed(54, 0);
    EXPECT_NEAR(totalVolume(tetMeshFromSoup(parseMeditBinary(bytes, "a.meshb")).mesh), 1.0 / 6.0, 1e-15);
    expectError([&] { parseMeditBinary(bytes.substr(0, 100), "a.meshb"); }, "a.meshb: ");
    expectError([] { parseMeditBinary("12345678", "a.meshb"); }, "does not begin as MEDIT binary does");
}

TEST(Tetgen, NumberedFromOneAndZeroWithAttributes) {
    for (const int first : {0, 1}) {
        std::string nodes = "# made by hand\n4 3 1 1\n";
        const std::vector<std::string> places{"0 0 0", "1 0 0", "0 1 0", "0 0 1"};
        for (int i = 0; i < 4; ++i) {
            nodes += fmt::format("{} {} {} 0\n", i + first, places[static_cast<std::size_t>(i)], 10 * i);
        }
        const std::string elements =
            fmt::format("1 4 1\n{} {} {} {} {} 5\n", first, first, first + 1, first + 2, first + 3);
        const ReadResult result = tetMeshFromSoup(parseTetgen(nodes, "a.node", elements, "a.ele"));
        EXPECT_NEAR(totalVolume(result.mesh), 1.0 / 6.0, 1e-15);
        EXPECT_EQ(result.mesh.fields[0].values[3], 30.0);
        EXPECT_EQ(result.mesh.fields[1].values[0], 5.0);
    }
}

TEST(Parsers, InvalidTextSaysWhatAndWhere) {
    const auto gmsh = [](const std::string& text) { return [text] { parseGmsh(text, "x.msh", {}); }; };
    expectError(gmsh(""), "x.msh: line 1: does not begin with $MeshFormat");
    expectError(gmsh("$MeshFormat\n4 1 8\n"), "save it as version 4.1 or 2.2");
    expectError(gmsh("$MeshFormat\n2.2 0 4\n"), "numbers of 4 bytes");
    expectError(gmsh("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n99999\n1 0 0 0\n"),
                "line 5: the number of nodes is 99999");
    expectError(gmsh("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n1\n1 0 zero 0\n$EndNodes\n"),
                "'zero' stands where a coordinate should");
    expectError(gmsh("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Elements\n1\n1 777 2 0 0 1 2 3\n$EndElements\n"),
                "Gmsh's type 777");
    expectError(gmsh(gmsh2.substr(0, 300)), "x.msh: line ");
    const auto tetgen = [](const std::string& nodes, const std::string& elements) {
        return [=] { parseTetgen(nodes, "x.node", elements, "x.ele"); };
    };
    expectError(tetgen("0 2 0 0", ""), "x.node: line 1: has points of a dimension other than 3");
    expectError(tetgen("0 3 0 0", "1 7 0\n"), "x.ele: ");
    expectError(tetgen("1 3 0 0\n1 0 0 0", ""), "x.ele: line 1: ends where the number of tetrahedra should stand");
    const auto text = [](const std::string& bytes) { return [bytes] { parseMeditText(bytes, "x.mesh"); }; };
    expectError(text("Vertices 3"), "does not begin with MeshVersionFormatted");
    expectError(text("MeshVersionFormatted 2 Dimension 2"), "has dimension 2");
    expectError(text("MeshVersionFormatted 2 Dimension 3 Vertices 12345678 0 0 0 0"), "too short");
}

TEST(Parsers, EveryPrefixIsReadOrRefused) {
    const auto tolerant = [](const std::function<CellSoup()>& parse) {
        try {
            tetMeshFromSoup(parse());
        } catch (const std::runtime_error&) {
        }
    };
    for (std::size_t size = 0; size < gmsh2.size(); ++size) {
        tolerant([&] { return parseGmsh(std::string_view(gmsh2).substr(0, size), "p.msh", {}); });
    }
    for (std::size_t size = 0; size < medit.size(); ++size) {
        tolerant([&] { return parseMeditText(std::string_view(medit).substr(0, size), "p.mesh"); });
    }
}

}  // namespace
}  // namespace tetralux::mesh
