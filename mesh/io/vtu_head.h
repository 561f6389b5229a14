// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace tetralux::mesh {

/// One array of a .vtu file.
struct VtuArray {
    enum class Place { Points, Cells, PointData, CellData };
    enum class Form { Appended, Inline, Text };  ///< encoded after all XML; encoded in base64 at its place; numbers
    std::string name;
    std::string type;  ///< "Float64", "Int32", …
    Place place = Place::Points;
    Form form = Form::Appended;
    int components = 1;
    std::vector<std::string> componentNames;  ///< empty, or one for each component
    std::uint64_t start = 0;  ///< of the data: in bytes from the start of the appended part, else of the file
    std::uint64_t end = 0;    ///< of the element, in bytes from the start of the file; not if appended
};

/// How encoded arrays are.
struct VtuEncoding {
    enum class Compression { None, Zlib, Lz4 };
    unsigned headerBytes = 4;  ///< of each number before an array: 4 or 8
    Compression compression = Compression::None;
    bool base64 = false;
};

/// One of the parts that a mesh stands in, each with points, cells and arrays of its own.
struct VtuPiece {
    std::uint64_t points = 0, cells = 0;
    std::vector<VtuArray> arrays;
};

/// What the XML of a .vtu file says.
struct VtuHead {
    VtuEncoding encoding;            ///< base64: of appended arrays; those at their place always are
    bool hexahedronsOfVtk8 = false;  ///< Lagrange and Bézier ones have their points in the order that VTK had before 9
    std::uint64_t dataStart = 0;     ///< of the appended part, in bytes from the start of the file
    std::vector<VtuPiece> pieces;    ///< at least one
};

/// The head of an open file, if it is of the plain kind described above in this machine's byte order; nothing for any
/// other file, sound or not: VTK's reader knows more dialects and has the better messages.
std::optional<VtuHead> parseVtuHead(int file);

}  // namespace tetralux::mesh
