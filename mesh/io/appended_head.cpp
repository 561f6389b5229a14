// SPDX-License-Identifier: Apache-2.0
#include <mesh/io/appended_head.h>

namespace tetralux::mesh {

std::string escapedXml(const std::string& text) {
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

AppendedHead::AppendedHead(const char* type)
    : xml_(fmt::format("<?xml version=\"1.0\"?>\n<VTKFile type=\"{0}\" version=\"1.0\" byte_order=\"{1}\" "
                       "header_type=\"UInt64\">\n<{0}>\n",
                       type, std::endian::native == std::endian::little ? "LittleEndian" : "BigEndian")) {}

void AppendedHead::declare(const char* type, const std::string& name, int components, std::uint64_t bytes,
                           const std::vector<std::string>& componentNames) {
    xml_ +=
        fmt::format("<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\"", type, escapedXml(name), components);
    for (std::size_t c = 0; c < componentNames.size(); ++c)
        xml_ += fmt::format(" ComponentName{}=\"{}\"", c, escapedXml(componentNames[c]));
    xml_ += fmt::format(" format=\"appended\" offset=\"{}\"/>\n", offset_);
    offset_ += sizeof(std::uint64_t) + bytes;
}

void AppendedHead::declareFields(const std::vector<Field>& fields, Association association) {
    const char* const tag = association == Association::Point ? "PointData" : "CellData";
    open(fmt::format("<{}>\n", tag));
    for (const Field& field : fields)
        if (field.association == association)
            declare("Float64", field.name, field.components, field.values.size() * sizeof(double),
                    field.componentNames);
    open(fmt::format("</{}>\n", tag));
}

std::string AppendedHead::finished(const char* type) const {
    return xml_ + fmt::format("</Piece>\n</{}>\n<AppendedData encoding=\"raw\">\n_", type);
}

}  // namespace tetralux::mesh
