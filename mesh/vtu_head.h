// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tetralux::mesh {

/// One array of a .vtu file with appended data.
struct VtuArray {
    enum class Place { Points, Cells, PointData, CellData };
    std::string name;
    std::string type;  ///< "Float64", "Int32", …
    Place place = Place::Points;
    int components = 1;
    std::uint64_t offset = 0;  ///< in bytes from the start of the appended data
};

/// What the XML of a .vtu file with one piece and all arrays appended says.
struct VtuHead {
    enum class Compression { None, Zlib, Lz4 };
    std::uint64_t points = 0, cells = 0;
    unsigned headerBytes = 4;  ///< of each number before an array: 4 or 8
    Compression compression = Compression::None;
    bool base64 = false;
    std::uint64_t dataStart = 0;  ///< where offsets count from, in bytes from the start of the file
    std::vector<VtuArray> arrays;
};

/// The head at the beginning of `text`, if it is of the plain kind described above in this machine's byte order;
/// nothing for any other file, sound or not: VTK's reader knows more dialects and has the better messages.
std::optional<VtuHead> parseVtuHead(std::string_view text);

}  // namespace tetralux::mesh
