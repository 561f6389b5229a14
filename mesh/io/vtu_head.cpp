// SPDX-License-Identifier: Apache-2.0
#include <mesh/io/vtu_head.h>

#include <bit>
#include <charconv>
#include <map>

#include <fmt/format.h>

#include <mesh/io/xml_tags.h>

namespace tetralux::mesh {
namespace {

template <class Number>
bool parseNumber(const std::string& text, Number& number) {
    const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    return error == std::errc() && stop == text.data() + text.size();
}

/// Whether `version`, "2.1", is before `major`.`minor`.
bool isBefore(const std::string& version, int major, int minor) {
    int first = 0;
    int second = 0;
    const std::size_t point = version.find('.');
    parseNumber(version.substr(0, point), first);
    if (point != std::string::npos) {
        parseNumber(version.substr(point + 1), second);
    }
    return first < major || (first == major && second < minor);
}

/// What the file calls them; nothing if it leaves out one.
std::vector<std::string> componentNames(const XmlTag& tag, int components) {
    std::vector<std::string> names;
    for (int c = 0; c < components; ++c) {
        const auto found = tag.attributes.find(fmt::format("ComponentName{}", c));
        if (found == tag.attributes.end()) {
            return {};
        }
        names.push_back(found->second);
    }
    return names;
}

class HeadParser {
public:
    explicit HeadParser(int file) : scan_(file) {}

    std::optional<VtuHead> parse() {
        while (const std::optional<XmlTag> tag = scan_.next()) {
            if (tag->name == "AppendedData") {
                return takeAppended(*tag) ? std::optional(std::move(head_)) : std::nullopt;
            }
            if (tag->name == "/VTKFile") {
                return !head_.pieces.empty() && !anyAppended_ ? std::optional(std::move(head_)) : std::nullopt;
            }
            if (!take(*tag)) {
                break;
            }
        }
        return std::nullopt;
    }

private:
    bool take(const XmlTag& tag) {
        if (arrayIsOpen_) {  // numbers end where VTK's further remarks begin
            head_.pieces.back().arrays.back().end = scan_.textEnd();
            arrayIsOpen_ = false;
        }
        if (tag.name == "FieldData" || tag.name == "/FieldData") {
            inFieldData_ = tag.name == "FieldData" && !tag.closesItself;
            return true;
        }
        if (inFieldData_ || tag.name == "?xml" || tag.name == "UnstructuredGrid" || tag.name == "InformationKey" ||
            tag.name == "Value") {
            return true;
        }
        if (tag.name.starts_with('/')) {
            const bool within = tag.name == "/DataArray" || tag.name == "/InformationKey" || tag.name == "/Value";
            section_ = within ? section_ : std::nullopt;
            return true;
        }
        if (tag.name == "VTKFile") {
            return takeFile(tag);
        }
        if (tag.name == "Piece") {
            VtuPiece& piece = head_.pieces.emplace_back();
            return parseNumber(tag.get("NumberOfPoints"), piece.points) &&
                   parseNumber(tag.get("NumberOfCells"), piece.cells);
        }
        return tag.name == "DataArray" ? takeArray(tag) : openSection(tag);
    }

    bool takeFile(const XmlTag& tag) {
        const std::string native = std::endian::native == std::endian::little ? "LittleEndian" : "BigEndian";
        const std::string width = tag.get("header_type", "UInt32");
        const std::string compressor = tag.get("compressor");
        head_.encoding.headerBytes = width == "UInt64" ? 8 : 4;
        head_.hexahedronsOfVtk8 = isBefore(tag.get("version", "0.1"), 2, 1);
        using Compression = VtuEncoding::Compression;
        head_.encoding.compression = compressor.empty()                      ? Compression::None
                                     : compressor == "vtkZLibDataCompressor" ? Compression::Zlib
                                                                             : Compression::Lz4;
        return tag.get("type") == "UnstructuredGrid" && tag.get("byte_order") == native &&
               (width == "UInt32" || width == "UInt64") &&
               (head_.encoding.compression != Compression::Lz4 || compressor == "vtkLZ4DataCompressor");
    }

    bool openSection(const XmlTag& tag) {
        static const std::map<std::string, VtuArray::Place> sections{{"Points", VtuArray::Place::Points},
                                                                     {"Cells", VtuArray::Place::Cells},
                                                                     {"PointData", VtuArray::Place::PointData},
                                                                     {"CellData", VtuArray::Place::CellData}};
        const auto found = sections.find(tag.name);
        if (found == sections.end()) {
            return false;
        }
        section_ = tag.closesItself ? std::nullopt : std::optional(found->second);
        return true;
    }

    bool takeArray(const XmlTag& tag) {
        VtuArray array;
        const std::string format = tag.get("format");
        if (!section_ || head_.pieces.empty() || !tag.get("TimeStep").empty() ||
            !parseNumber(tag.get("NumberOfComponents", "1"), array.components) || array.components < 1 ||
            array.components > 1000) {
            return false;
        }
        if (format == "appended") {
            anyAppended_ = true;
            if (!parseNumber(tag.get("offset"), array.start)) {
                return false;
            }
        } else {
            array.form = format == "ascii" ? VtuArray::Form::Text : VtuArray::Form::Inline;
            array.start = array.end = scan_.following().second;
            if (format != "ascii" && format != "binary") {
                return false;
            }
        }
        arrayIsOpen_ = !tag.closesItself;
        array.name = tag.get("Name");
        array.type = tag.get("type");
        array.place = *section_;
        array.componentNames = componentNames(tag, array.components);
        head_.pieces.back().arrays.push_back(std::move(array));
        return true;
    }

    bool takeAppended(const XmlTag& tag) {
        const std::string encoding = tag.get("encoding");
        head_.encoding.base64 = encoding == "base64";
        const auto [first, place] = scan_.following();
        head_.dataStart = place + 1;
        return !head_.pieces.empty() && (encoding == "raw" || encoding == "base64") && first == '_';
    }

    XmlTags scan_;
    VtuHead head_;
    std::optional<VtuArray::Place> section_;
    bool inFieldData_ = false;
    bool anyAppended_ = false;
    bool arrayIsOpen_ = false;
};

}  // namespace

std::optional<VtuHead> parseVtuHead(int file) {
    return HeadParser(file).parse();
}

}  // namespace tetralux::mesh
