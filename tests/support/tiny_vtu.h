// SPDX-License-Identifier: Apache-2.0
/// \file
/// VTK XML files of a few tetrahedra, as text.
#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include <fmt/format.h>

namespace tetralux::tests {

struct TinyMesh {
    std::vector<std::array<double, 3>> points;
    std::vector<std::array<int, 4>> cells;
    std::vector<double> values;  ///< one per point, field "s"; NaN and infinity are kept
};

inline std::string base64(const std::string& bytes) {
    static constexpr char letters[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t group = 0;
        for (std::size_t k = 0; k < 3; ++k)
            group = group << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
        for (std::size_t k = 0; k < 4; ++k) text += i + k > bytes.size() ? '=' : letters[group >> (18 - 6 * k) & 63];
    }
    return text;
}

/// Positions and cells as readable text, values as base64: VTK's text form has no NaN.
inline std::string vtuText(const TinyMesh& mesh) {
    std::string points, cells, offsets, types;
    for (const auto& p : mesh.points) points += fmt::format("{} {} {} ", p[0], p[1], p[2]);
    for (std::size_t i = 0; i < mesh.cells.size(); ++i) {
        const auto& c = mesh.cells[i];
        cells += fmt::format("{} {} {} {} ", c[0], c[1], c[2], c[3]);
        offsets += fmt::format("{} ", 4 * (i + 1));
        types += "10 ";
    }
    const auto size = static_cast<std::uint32_t>(mesh.values.size() * sizeof(double));
    std::string raw(sizeof size + size, '\0');
    std::memcpy(raw.data(), &size, sizeof size);
    if (size > 0) std::memcpy(raw.data() + sizeof size, mesh.values.data(), size);
    return fmt::format(
        R"(<VTKFile type="UnstructuredGrid" version="1.0" byte_order="LittleEndian" header_type="UInt32"><UnstructuredGrid>
<Piece NumberOfPoints="{}" NumberOfCells="{}">
<PointData><DataArray type="Float64" Name="s" format="binary">{}</DataArray></PointData>
<Points><DataArray type="Float64" NumberOfComponents="3" format="ascii">{}</DataArray></Points>
<Cells><DataArray type="Int64" Name="connectivity" format="ascii">{}</DataArray>
<DataArray type="Int64" Name="offsets" format="ascii">{}</DataArray>
<DataArray type="UInt8" Name="types" format="ascii">{}</DataArray></Cells>
</Piece></UnstructuredGrid></VTKFile>
)",
        mesh.points.size(), mesh.cells.size(), base64(raw), points, cells, offsets, types);
}

}  // namespace tetralux::tests
