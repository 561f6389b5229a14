// SPDX-License-Identifier: Apache-2.0
/// \file
/// MEDIT meshes (INRIA report RT-0253, Frey 2001; binary layout and keyword numbers as in libMeshb).
#include <algorithm>
#include <array>
#include <filesystem>
#include <stdexcept>

#include <fmt/format.h>

#include <mesh/io/file_checks.h>
#include <mesh/io/mesh_format.h>
#include <mesh/io/parse_mesh.h>
#include <mesh/io/region_field.h>
#include <mesh/io/text_scanner.h>
#include <mesh/soup/cell_types.h>

namespace tetralux::mesh {
namespace {

struct CellKeyword {
    const char* text;
    int binary;
    std::uint8_t type;
    std::size_t points;
};
constexpr std::array<CellKeyword, 5> cellKeywords{{{"Tetrahedra", 8, cell_type::tetrahedron, 4},
                                                   {"Prisms", 9, cell_type::wedge, 6},
                                                   {"Wedges", 9, cell_type::wedge, 6},
                                                   {"Hexahedra", 10, cell_type::hexahedron, 8},
                                                   {"Pyramids", 49, cell_type::pyramid, 5}}};
constexpr int binaryVertices = 4;
constexpr int binaryDimension = 3;
constexpr int binaryEnd = 54;

/// Points count from 1. Prisms run the other way round than VTK's, which decomposition does not mind.
std::uint32_t pointNumber(std::int64_t id) {
    return id < 1 || id > static_cast<std::int64_t>(CellSoup::invalidPoint) ? CellSoup::invalidPoint
                                                                            : static_cast<std::uint32_t>(id - 1);
}

void parseVertices(TextScanner& scan, CellSoup& soup) {
    const std::size_t count = scan.count("the number of vertices", 8);
    soup.points.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
        glm::dvec3 x;
        for (int axis = 0; axis < 3; ++axis) {
            x[axis] = scan.number("a coordinate");
        }
        soup.points.push_back(x);
        scan.word("the reference of a vertex");
    }
}

void parseCells(TextScanner& scan, const CellKeyword& keyword, CellSoup& soup, std::vector<double>& references) {
    const std::size_t count = scan.count("the number of cells", 2 * keyword.points + 2);
    std::array<std::uint32_t, 8> ids{};
    for (std::size_t i = 0; i < count; ++i) {
        for (std::size_t k = 0; k < keyword.points; ++k) {
            ids[k] = pointNumber(scan.integer("a point of a cell"));
        }
        appendCell(soup, keyword.type, std::span(ids.data(), keyword.points));
        references.push_back(scan.number("the reference of a cell"));
    }
}

void checkDimension(TextScanner& scan, std::int64_t dimension) {
    if (dimension != 3) {
        scan.refuse(fmt::format("has dimension {}, which holds no solid cells", dimension),
                    "give a mesh of dimension 3");
    }
}

/// Fixed-size numbers out of bytes of either order.
class BinaryScanner {
public:
    BinaryScanner(std::string_view bytes, const std::string& source)
        : scan_(bytes, source, '\0'), all_(bytes), source_(source) {
        const auto code = take<std::int32_t>("the byte order");
        swap_ = code != 1;
        if (swap_ && code != 0x01000000) {
            refuse("does not begin as MEDIT binary does", "check the name's ending or write the file again");
        }
        version_ = take<std::int32_t>("the version");
        if (version_ < 1 || version_ > 4) {
            refuse(fmt::format("has version {}; 1 to 4 can be read", version_), "save it as version 2");
        }
    }

    template <class T>
    T take(const char* what) {
        return takeBinary<T>(scan_, swap_, what);
    }
    std::int64_t takeInteger(const char* what) {
        return version_ >= 4 ? take<std::int64_t>(what) : take<std::int32_t>(what);
    }
    std::int64_t takePlace(const char* what) {
        return version_ >= 3 ? take<std::int64_t>(what) : take<std::int32_t>(what);
    }
    double takeReal(const char* what) {
        return version_ == 1 ? static_cast<double>(take<float>(what)) : take<double>(what);
    }
    std::size_t takeCount(const char* what, std::size_t bytesEach) {
        const std::int64_t count = takeInteger(what);
        if (count < 0 || static_cast<std::uint64_t>(count) > scan_.remaining() / bytesEach) {
            fail(fmt::format("{} is {}, but the file is too short for that", what, count));
        }
        return static_cast<std::size_t>(count);
    }
    std::size_t integerSize() const { return version_ >= 4 ? 8 : 4; }
    std::size_t realSize() const { return version_ == 1 ? 4 : 8; }

    /// Moves to `place`, which must lie ahead.
    void jump(std::int64_t place) {
        const auto here = static_cast<std::int64_t>(scan_.position());
        if (place < here || place > static_cast<std::int64_t>(all_.size())) {
            fail("has a section that does not end where it says");
        }
        scan_.bytes(static_cast<std::size_t>(place - here), "a section");
    }
    bool atEnd() const { return scan_.remaining() < 4; }

    [[noreturn]] void fail(const std::string& what) const {
        refuse(what, "the file is probably truncated or damaged: write it again");
    }
    [[noreturn]] void refuse(const std::string& what, const char* remedy) const {
        throw std::runtime_error(fmt::format("{}: byte {}: {}; {}", source_, scan_.position(), what, remedy));
    }

private:
    TextScanner scan_;
    std::string_view all_;
    std::string source_;
    bool swap_ = false;
    std::int32_t version_ = 0;
};

void takeBinarySection(BinaryScanner& scan, int keyword, CellSoup& soup, std::vector<double>& references) {
    if (keyword == binaryVertices) {
        const std::size_t count = scan.takeCount("the number of vertices", 3 * scan.realSize() + scan.integerSize());
        for (std::size_t i = 0; i < count; ++i) {
            glm::dvec3 x;
            for (int axis = 0; axis < 3; ++axis) {
                x[axis] = scan.takeReal("a coordinate");
            }
            soup.points.push_back(x);
            scan.takeInteger("the reference of a vertex");
        }
    }
    const auto cells = std::find_if(cellKeywords.begin(), cellKeywords.end(),
                                    [&](const CellKeyword& k) { return k.binary == keyword; });
    if (cells != cellKeywords.end()) {
        const std::size_t count = scan.takeCount("the number of cells", (cells->points + 1) * scan.integerSize());
        std::array<std::uint32_t, 8> ids{};
        for (std::size_t i = 0; i < count; ++i) {
            for (std::size_t k = 0; k < cells->points; ++k) {
                ids[k] = pointNumber(scan.takeInteger("a point of a cell"));
            }
            appendCell(soup, cells->type, std::span(ids.data(), cells->points));
            references.push_back(static_cast<double>(scan.takeInteger("the reference of a cell")));
        }
    }
}

bool acceptsMedit(const std::string& source) {
    return hasExtension(source, {".mesh", ".meshb"});
}

CellSoup readMedit(const std::string& source, const ReadOptions&) {
    const std::string bytes = readWholeFile(source);
    CellSoup soup = hasExtension(source, {".meshb"}) ? parseMeditBinary(bytes, source) : parseMeditText(bytes, source);
    const std::string solution = std::filesystem::path(source).replace_extension(".sol").string();
    std::error_code failed;
    if (std::filesystem::is_regular_file(solution, failed)) {
        parseMeditSolution(readWholeFile(solution), solution, soup);
    }
    return soup;
}

}  // namespace

CellSoup parseMeditText(std::string_view bytes, const std::string& source) {
    TextScanner scan(bytes, source, '#');
    if (scan.peek() != "MeshVersionFormatted") {
        const bool isMfem = scan.peek() == "MFEM";
        scan.refuse(isMfem ? "is a mesh in MFEM's own format, which is not read"
                           : "does not begin with MeshVersionFormatted as a MEDIT mesh does",
                    isMfem ? "save it as .vtu or .vtk (Mesh::PrintVTU, Mesh::PrintVTK)"
                           : "check the name's ending or write the file again");
    }
    CellSoup soup;
    std::vector<double> references;
    while (!scan.atEnd()) {
        const std::string_view word = scan.word("a keyword");
        const auto cells = std::find_if(cellKeywords.begin(), cellKeywords.end(),
                                        [&](const CellKeyword& k) { return word == k.text; });
        if (word == "End") {
            break;
        }
        if (word == "Dimension") {
            checkDimension(scan, scan.integer("the dimension"));
        } else if (word == "Vertices") {
            parseVertices(scan, soup);
        } else if (cells != cellKeywords.end()) {
            parseCells(scan, *cells, soup, references);
        }
        // Numbers of all other sections are passed over up to the next keyword.
    }
    addRegionField(soup, "reference", std::move(references));
    return soup;
}

CellSoup parseMeditBinary(std::string_view bytes, const std::string& source) {
    BinaryScanner scan(bytes, source);
    CellSoup soup;
    std::vector<double> references;
    while (!scan.atEnd()) {
        const auto keyword = scan.take<std::int32_t>("a keyword");
        if (keyword == binaryEnd) {
            break;
        }
        const std::int64_t next = scan.takePlace("the end of a section");
        if (keyword == binaryDimension) {
            if (scan.take<std::int32_t>("the dimension") != 3) {
                scan.refuse("is not three-dimensional and holds no solid cells", "give a mesh of dimension 3");
            }
        } else {
            takeBinarySection(scan, keyword, soup, references);
        }
        if (next == 0) {
            break;
        }
        scan.jump(next);
    }
    addRegionField(soup, "reference", std::move(references));
    return soup;
}

void parseMeditSolution(std::string_view bytes, const std::string& source, CellSoup& soup) {
    TextScanner scan(bytes, source, '#');
    while (!scan.atEnd() && scan.word("a keyword") != "SolAtVertices") {
    }
    if (scan.atEnd()) {
        return;  // solutions on edges or faces only
    }
    const std::size_t vertices = scan.count("the number of vertices", 2);
    if (vertices != soup.points.size()) {
        scan.refuse(fmt::format("has values at {} vertices where the mesh has {}", vertices, soup.points.size()),
                    "put the .sol of this mesh beside it, or none");
    }
    const std::size_t solutions = scan.count("the number of solutions", 2);
    std::vector<Field> fields;
    for (std::size_t i = 0; i < solutions; ++i) {
        const std::int64_t kind = scan.integer("the kind of a solution");
        if (kind < 1 || kind > 3) {
            scan.refuse(
                fmt::format("has a solution of kind {} where 1 (scalar), 2 (vector), 3 (tensor) are known", kind),
                "write it as one of these");
        }
        Field field;
        field.name = solutions == 1 ? "solution" : fmt::format("solution {}", i + 1);
        field.components = kind == 1 ? 1 : kind == 2 ? 3 : 6;
        fields.push_back(std::move(field));
    }
    for (std::size_t i = 0; i < vertices; ++i) {
        for (Field& field : fields) {
            for (int c = 0; c < field.components; ++c) {
                field.values.push_back(scan.number("a value"));
            }
        }
    }
    for (Field& field : fields) {
        soup.fields.push_back(std::move(field));
    }
}

const MeshFormat meditFormat{"MEDIT", ".mesh .meshb, with .sol", acceptsMedit, readMedit};

}  // namespace tetralux::mesh
