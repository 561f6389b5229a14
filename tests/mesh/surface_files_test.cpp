// SPDX-License-Identifier: Apache-2.0
//
// Surfaces as files: what VTK reads of them is what was written. tests/outside/check_surfaces.py reads the fields.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include <gtest/gtest.h>
#include <unistd.h>

#include <mesh/io/read_surface.h>
#include <mesh/tet/field_surface.h>

namespace tetralux::mesh {
namespace {

FieldSurface tetrahedron(double size, const glm::dvec3& corner) {
    FieldSurface surface;
    surface.positions = {corner, corner + glm::dvec3(size, 0, 0), corner + glm::dvec3(0, size, 0),
                         corner + glm::dvec3(0, 0, size)};
    for (const auto& face : faceVertices)
        surface.triangles.push_back(
            {static_cast<PointIndex>(face[0]), static_cast<PointIndex>(face[1]), static_cast<PointIndex>(face[2])});
    surface.fields = {{"pressure (Pa) <&\">", Association::Point, 1, {1, 2, 3, 4}},
                      {"pressure_(Pa)_<&\">", Association::Point, 1, {5, 6, 7, 8}},
                      {"x", Association::Point, 3, std::vector<double>(12, 0.5)},
                      {"part", Association::Cell, 1, {0, 1, 2, 3}}};
    return surface;
}

class SurfaceFiles : public testing::Test {
protected:
    SurfaceFiles()
        : folder_(std::filesystem::temp_directory_path() / ("tetralux-surfaces-" + std::to_string(::getpid()))) {
        std::filesystem::create_directories(folder_);
    }
    ~SurfaceFiles() override { std::filesystem::remove_all(folder_); }

    SurfaceMesh writtenAndRead(const FieldSurface& surface, const std::string& name) const {
        const std::string path = (folder_ / name).string();
        std::ofstream(path, std::ios::binary) << surfaceFile(surface, surfaceFormat(path));
        return readSurface(path);
    }
    std::filesystem::path folder_;
};

TEST_F(SurfaceFiles, AreReadAsTheyWereWritten) {
    const FieldSurface surface = tetrahedron(1.5, {0.25, -3, 7});  // exact in single precision
    for (const std::string name : {"a.vtp", "a.ply", "a.STL"}) {
        const SurfaceMesh read = writtenAndRead(surface, name);
        ASSERT_EQ(read.triangles.size(), 4u) << name;
        EXPECT_EQ(read.positions.size(), 4u) << name;
        for (std::size_t i = 0; i < 4; ++i)
            for (std::size_t k = 0; k < 3; ++k)
                EXPECT_EQ(read.positions[read.triangles[i][k]], surface.positions[surface.triangles[i][k]]) << name;
    }
}

TEST_F(SurfaceFiles, KeepDoublesWhereTheFormatDoes) {
    const FieldSurface surface = tetrahedron(0.1, {1e7 / 3, 0, 0});
    const SurfaceMesh read = writtenAndRead(surface, "a.vtp");
    for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(read.positions[i], surface.positions[i]);
}

TEST_F(SurfaceFiles, PropertiesHaveNamesOfTheirOwn) {
    const std::string ply = surfaceFile(tetrahedron(1, {0, 0, 0}), SurfaceFormat::Ply);
    const std::string head = ply.substr(0, ply.find("end_header"));
    for (const char* line :
         {"property double pressure__Pa______\n", "property double pressure__Pa_______\n",
          "property double x_x\nproperty double x_y\nproperty double x_z\n", "property double part\n"})
        EXPECT_NE(head.find(line), std::string::npos) << line << head;
    EXPECT_NE(surfaceFile(tetrahedron(1, {0, 0, 0}), SurfaceFormat::Vtp).find("\"pressure (Pa) &lt;&amp;&quot;&gt;\""),
              std::string::npos);
}

TEST_F(SurfaceFiles, StlRefusesWhatSinglePrecisionWouldBlur) {
    for (const double where : {1e7, 1e39})
        EXPECT_THROW(surfaceFile(tetrahedron(1, {where, 0, 0}), SurfaceFormat::Stl), std::runtime_error) << where;
    EXPECT_NO_THROW(surfaceFile(tetrahedron(1, {100, 0, 0}), SurfaceFormat::Stl));
    // triangles that rounding makes edges are left out: their neighbours meet
    FieldSurface surface = tetrahedron(1, {0, 0, 0});
    surface.positions.push_back(surface.positions[1] + glm::dvec3(1e-12, 0, 0));
    surface.triangles.push_back({1, 4, 2});
    EXPECT_EQ(writtenAndRead(surface, "a.stl").triangles.size(), 4u);
}

TEST_F(SurfaceFiles, UnknownEndingsAreRefused) {
    EXPECT_THROW(surfaceFormat("a.obj"), std::runtime_error);
    EXPECT_THROW(surfaceFormat("vtp"), std::runtime_error);
}

}  // namespace
}  // namespace tetralux::mesh
