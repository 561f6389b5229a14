// SPDX-License-Identifier: Apache-2.0
/// \file
/// Small meshes and what must hold of them, for the tests of mesh/.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <mesh/io/read_mesh.h>
#include <mesh/soup/cell_soup.h>
#include <mesh/soup/cell_types.h>
#include <mesh/tet/tet_mesh.h>

namespace tetralux::mesh::test {

inline double cellVolume(const TetMesh& mesh, std::size_t i) {
    const Tetrahedron& t = mesh.cells[i];
    return sixVolumes(mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]], mesh.positions[t[3]]) / 6.0;
}

inline double totalVolume(const TetMesh& mesh) {
    double sum = 0.0;
    for (std::size_t i = 0; i < mesh.cells.size(); ++i) {
        EXPECT_GT(cellVolume(mesh, i), 0.0) << "cell " << i;
        sum += cellVolume(mesh, i);
    }
    return sum;
}

inline double linearField(const glm::dvec3& x) {
    return 0.3 + 1.7 * x.x - 0.9 * x.y + 0.4 * x.z;
}

inline void addPointField(CellSoup& soup, const std::string& name, const std::function<double(const glm::dvec3&)>& f) {
    Field field;
    field.name = name;
    for (const glm::dvec3& x : soup.points) {
        field.values.push_back(f(x));
    }
    soup.fields.push_back(std::move(field));
}

/// The largest difference between the first field and `f` over the points of the mesh.
inline double largestError(const TetMesh& mesh, const std::function<double(const glm::dvec3&)>& f) {
    double error = 0.0;
    for (std::size_t p = 0; p < mesh.positions.size(); ++p) {
        error = std::max(error, std::abs(mesh.fields[0].values[p] - f(mesh.positions[p])));
    }
    return error;
}

/// n³ cubes of the unit cube, each made into cells by `addCube(soup, corner)` where corner[bits zyx] are its points.
/// Points are numbered at random, so that no rule about point numbers is met by luck, and moved by `warp`.
inline CellSoup cubeGrid(int n, unsigned seed, const std::function<glm::dvec3(const glm::dvec3&)>& warp,
                         const std::function<void(CellSoup&, const std::array<std::uint32_t, 8>&)>& addCube) {
    const int edge = n + 1;
    std::vector<std::uint32_t> number(static_cast<std::size_t>(edge * edge * edge));
    std::iota(number.begin(), number.end(), 0u);
    std::shuffle(number.begin(), number.end(), std::mt19937(seed));
    CellSoup soup;
    soup.points.resize(number.size());
    const auto at = [&](int i, int j, int k) {
        const int place = i + edge * (j + edge * k);
        return number[static_cast<std::size_t>(place)];
    };
    for (int k = 0; k < edge; ++k) {
        for (int j = 0; j < edge; ++j) {
            for (int i = 0; i < edge; ++i) {
                soup.points[at(i, j, k)] = warp(glm::dvec3(i, j, k) / static_cast<double>(n));
            }
        }
    }
    for (int k = 0; k < n; ++k) {
        for (int j = 0; j < n; ++j) {
            for (int i = 0; i < n; ++i) {
                std::array<std::uint32_t, 8> corner{};
                for (int bits = 0; bits < 8; ++bits) {
                    corner[static_cast<std::size_t>(bits)] = at(i + (bits & 1), j + (bits >> 1 & 1), k + (bits >> 2));
                }
                addCube(soup, corner);
            }
        }
    }
    return soup;
}

/// Leaves the surface of the unit cube where it is and bends everything within, so that faces inside are not planar.
inline glm::dvec3 bend(const glm::dvec3& x) {
    const double amount =
        0.5 * std::sin(3.14159265358979 * x.x) * std::sin(3.14159265358979 * x.y) * std::sin(3.14159265358979 * x.z);
    return x + amount *
                   glm::dvec3(0.31 * std::sin(9.0 * x.y), 0.23 * std::cos(7.0 * x.z), 0.27 * std::sin(8.0 * x.x + 1.0));
}

inline glm::dvec3 straight(const glm::dvec3& x) {
    return x;
}

/// A folder that goes with the test.
class TemporaryFolder {
public:
    TemporaryFolder() {
        std::string pattern = (std::filesystem::temp_directory_path() / "tetralux-mesh-XXXXXX").string();
        path_ = ::mkdtemp(pattern.data());
    }
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;
    ~TemporaryFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    std::string file(const std::string& name) const { return (path_ / name).string(); }
    std::string write(const std::string& name, const std::string& content) const {
        std::ofstream(path_ / name, std::ios::binary) << content;
        return file(name);
    }

private:
    std::filesystem::path path_;
};

/// The text of the exception that `action` throws; fails the test if it throws none or one of several lines.
inline std::string errorOf(const std::function<void()>& action) {
    try {
        action();
    } catch (const std::runtime_error& error) {
        std::string text = error.what();
        EXPECT_EQ(text.find('\n'), std::string::npos) << text;
        return text;
    }
    ADD_FAILURE() << "no error";
    return {};
}

inline void expectError(const std::function<void()>& action, const std::string& part) {
    const std::string text = errorOf(action);
    EXPECT_NE(text.find(part), std::string::npos) << "got: " << text << "\nwant: " << part;
}

inline std::uint64_t countOf(const MeshReport& report, Defect defect) {
    const auto found = report.defects.find(defect);
    return found == report.defects.end() ? 0 : found->second.count;
}

}  // namespace tetralux::mesh::test
