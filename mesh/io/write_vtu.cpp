// SPDX-License-Identifier: Apache-2.0
#include <mesh/io/write_vtu.h>

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include <fmt/format.h>
#include <unistd.h>

#include <mesh/io/appended_head.h>

namespace tetralux::mesh {
namespace {

constexpr std::uint8_t vtkTetra = 10;

constexpr const char* grid = "UnstructuredGrid";

std::string makeHead(const TetMesh& mesh) {
    AppendedHead head(grid);
    head.open(fmt::format("<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n<Points>\n", mesh.positions.size(),
                          mesh.cells.size()));
    head.declare("Float64", "Points", 3, mesh.positions.size() * 3 * sizeof(double));
    head.open("</Points>\n<Cells>\n");
    head.declare("Int64", "connectivity", 1, mesh.cells.size() * 4 * sizeof(std::int64_t));
    head.declare("Int64", "offsets", 1, mesh.cells.size() * sizeof(std::int64_t));
    head.declare("UInt8", "types", 1, mesh.cells.size());
    head.open("</Cells>\n");
    head.declareFields(mesh.fields, Association::Point);
    head.declareFields(mesh.fields, Association::Cell);
    return head.finished(grid);
}

void putMesh(std::ostream& out, const TetMesh& mesh) {
    out << makeHead(mesh);
    putArray(out, mesh.positions);
    putMade<std::int64_t>(out, 4 * mesh.cells.size(), [&](std::uint64_t i) { return mesh.cells[i >> 2][i & 3]; });
    putMade<std::int64_t>(out, mesh.cells.size(), [](std::uint64_t i) { return 4 * (i + 1); });
    putMade<std::uint8_t>(out, mesh.cells.size(), [](std::uint64_t) { return vtkTetra; });
    putFields(out, mesh.fields, Association::Point);
    putFields(out, mesh.fields, Association::Cell);
    out << appendedTail;
}

}  // namespace

void writeVtu(const std::string& path, const TetMesh& mesh) {
    const std::string beside = fmt::format("{}.{}.part", path, ::getpid());
    std::error_code failed;
    {
        std::ofstream out(beside, std::ios::binary | std::ios::trunc);
        if (!out) {
            throw std::runtime_error(
                fmt::format("{}: cannot be written; check that the folder exists and may be written", path));
        }
        putMesh(out, mesh);
        out.close();
        if (!out) {
            std::filesystem::remove(beside, failed);
            throw std::runtime_error(fmt::format("{}: could not be written to the end; is the disk full?", path));
        }
    }
    std::filesystem::rename(beside, path, failed);
    if (failed) {
        std::error_code ignored;
        std::filesystem::remove(beside, ignored);
        throw std::runtime_error(fmt::format("{}: cannot be replaced ({}); give another name", path, failed.message()));
    }
}

}  // namespace tetralux::mesh
