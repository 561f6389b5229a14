// SPDX-License-Identifier: Apache-2.0
#include <mesh/io/read_mesh.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>

#include <gtest/gtest.h>

namespace tetralux::mesh {
namespace {

std::string inFolder(const std::string& name) {
    return (std::filesystem::temp_directory_path() / ("read_own_mesh_" + name)).string();
}

void write(const std::string& path, const std::string& text) {
    std::ofstream(path) << text;
}

TEST(ReadOwnMesh, MakesGeneratedFields) {
    const auto own = readOwnMesh("bucky:5");
    ASSERT_TRUE(own.has_value());
    EXPECT_EQ(own->mesh.cells.size(), 320u);
}

TEST(ReadOwnMesh, ReadsFilesThatNeedNoVtk) {
    const std::string gmsh = inFolder("a.msh");
    write(gmsh,
          "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n$EndNodes\n"
          "$Elements\n1\n1 4 2 1 1 1 2 3 4\n$EndElements\n");
    const auto own = readOwnMesh(gmsh);
    ASSERT_TRUE(own.has_value());
    EXPECT_EQ(own->mesh.cells.size(), 1u);
    std::filesystem::remove(gmsh);
}

TEST(ReadOwnMesh, LeavesTheRestToOthers) {
    const std::string other = inFolder("a.vtu");
    write(other, "<VTKFile type=\"UnstructuredGrid\"><UnstructuredGrid></UnstructuredGrid></VTKFile>");
    EXPECT_FALSE(readOwnMesh(other).has_value());
    EXPECT_FALSE(readOwnMesh(inFolder("a.cgns")).has_value());
    std::filesystem::remove(other);
    EXPECT_THROW(readOwnMesh(inFolder("none.vtu")), std::runtime_error);
    EXPECT_THROW(readOwnMesh(inFolder("none.msh")), std::runtime_error);
}

}  // namespace
}  // namespace tetralux::mesh
