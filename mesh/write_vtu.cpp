// SPDX-License-Identifier: Apache-2.0
#include <mesh/write_vtu.h>

#include <bit>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include <fmt/format.h>
#include <unistd.h>

namespace tetralux::mesh {
namespace {

constexpr std::uint8_t vtkTetra = 10;

std::string escaped(const std::string& text) {
    std::string out;
    for (const char c : text) {
        switch (c) {
            case '&':
                out += "&amp;";
                break;
            case '<':
                out += "&lt;";
                break;
            case '>':
                out += "&gt;";
                break;
            case '"':
                out += "&quot;";
                break;
            default:
                out += c;
        }
    }
    return out;
}

/// The XML head. Arrays stand behind it in the order in which they are declared here.
class Head {
public:
    void open(const std::string& text) { xml_ += text; }
    void declare(const char* type, const std::string& name, int components, std::uint64_t bytes) {
        xml_ += fmt::format(
            "<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"appended\" offset=\"{}\"/>\n", type,
            escaped(name), components, offset_);
        offset_ += sizeof(std::uint64_t) + bytes;
    }
    const std::string& text() const { return xml_; }

private:
    std::string xml_;
    std::uint64_t offset_ = 0;
};

void declareFields(Head& head, const TetMesh& mesh, Association association) {
    for (const Field& field : mesh.fields) {
        if (field.association == association) {
            head.declare("Float64", field.name, field.components, field.values.size() * sizeof(double));
        }
    }
}

std::string makeHead(const TetMesh& mesh) {
    const char* order = std::endian::native == std::endian::little ? "LittleEndian" : "BigEndian";
    Head head;
    head.open(
        fmt::format("<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"{}\" "
                    "header_type=\"UInt64\">\n<UnstructuredGrid>\n<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n",
                    order, mesh.positions.size(), mesh.cells.size()));
    head.open("<Points>\n");
    head.declare("Float64", "Points", 3, mesh.positions.size() * 3 * sizeof(double));
    head.open("</Points>\n<Cells>\n");
    head.declare("Int64", "connectivity", 1, mesh.cells.size() * 4 * sizeof(std::int64_t));
    head.declare("Int64", "offsets", 1, mesh.cells.size() * sizeof(std::int64_t));
    head.declare("UInt8", "types", 1, mesh.cells.size());
    head.open("</Cells>\n<PointData>\n");
    declareFields(head, mesh, Association::Point);
    head.open("</PointData>\n<CellData>\n");
    declareFields(head, mesh, Association::Cell);
    head.open("</CellData>\n</Piece>\n</UnstructuredGrid>\n<AppendedData encoding=\"raw\">\n_");
    return head.text();
}

template <class T>
void put(std::ofstream& out, const T* values, std::uint64_t count) {
    out.write(reinterpret_cast<const char*>(values), static_cast<std::streamsize>(count * sizeof(T)));
}

/// `count` values made by `valueAt`, in pieces, so that no second copy of the mesh is needed.
template <class T, class ValueAt>
void putMade(std::ofstream& out, std::uint64_t count, const ValueAt& valueAt) {
    const std::uint64_t bytes = count * sizeof(T);
    put(out, &bytes, 1);
    std::vector<T> piece;
    constexpr std::size_t pieceSize = 65536;
    for (std::uint64_t i = 0; i < count; ++i) {
        piece.push_back(static_cast<T>(valueAt(i)));
        if (piece.size() == pieceSize || i + 1 == count) {
            put(out, piece.data(), piece.size());
            piece.clear();
        }
    }
}

void putFields(std::ofstream& out, const TetMesh& mesh, Association association) {
    for (const Field& field : mesh.fields) {
        if (field.association == association) {
            const std::uint64_t bytes = field.values.size() * sizeof(double);
            put(out, &bytes, 1);
            put(out, field.values.data(), field.values.size());
        }
    }
}

void putMesh(std::ofstream& out, const TetMesh& mesh) {
    const std::string head = makeHead(mesh);
    put(out, head.data(), head.size());
    const std::uint64_t pointBytes = mesh.positions.size() * sizeof(glm::dvec3);
    put(out, &pointBytes, 1);
    put(out, mesh.positions.data(), mesh.positions.size());
    putMade<std::int64_t>(out, 4 * mesh.cells.size(), [&](std::uint64_t i) { return mesh.cells[i >> 2][i & 3]; });
    putMade<std::int64_t>(out, mesh.cells.size(), [](std::uint64_t i) { return 4 * (i + 1); });
    putMade<std::uint8_t>(out, mesh.cells.size(), [](std::uint64_t) { return vtkTetra; });
    putFields(out, mesh, Association::Point);
    putFields(out, mesh, Association::Cell);
    const std::string tail = "\n</AppendedData>\n</VTKFile>\n";
    put(out, tail.data(), tail.size());
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
