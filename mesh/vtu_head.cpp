// SPDX-License-Identifier: Apache-2.0
#include <mesh/vtu_head.h>

#include <array>
#include <bit>
#include <cctype>
#include <charconv>
#include <map>
#include <utility>

namespace tetralux::mesh {
namespace {

struct Tag {
    std::string name;  ///< "/Piece" for a closing tag
    std::map<std::string, std::string> attributes;
    bool closesItself = false;

    std::string get(const std::string& attribute, const std::string& otherwise = {}) const {
        const auto found = attributes.find(attribute);
        return found == attributes.end() ? otherwise : found->second;
    }
};

bool isSpace(char c) {
    return c == ' ' || c == '\n' || c == '\t' || c == '\r';
}

/// Replaces the five named entities. \returns false for any other.
bool decodeEntities(std::string& text) {
    static constexpr std::array<std::pair<std::string_view, char>, 5> entities{
        {{"&lt;", '<'}, {"&gt;", '>'}, {"&quot;", '"'}, {"&apos;", '\''}, {"&amp;", '&'}}};
    std::string decoded;
    for (std::size_t i = 0; i < text.size();) {
        if (text[i] != '&') {
            decoded += text[i++];
            continue;
        }
        const std::string_view rest = std::string_view(text).substr(i);
        bool known = false;
        for (const auto& [entity, character] : entities) {
            if (rest.starts_with(entity)) {
                decoded += character;
                i += entity.size();
                known = true;
                break;
            }
        }
        if (!known) {
            return false;
        }
    }
    text = std::move(decoded);
    return true;
}

/// Takes one tag after another; what stands between them is passed over.
class TagScanner {
public:
    explicit TagScanner(std::string_view text) : text_(text) {}

    std::optional<Tag> next() {
        at_ = text_.find('<', at_);
        if (at_ == std::string_view::npos) {
            return std::nullopt;
        }
        ++at_;
        Tag tag;
        while (at_ < text_.size() && !isSpace(text_[at_]) && text_[at_] != '>' &&
               (text_[at_] != '/' || tag.name.empty())) {
            tag.name += text_[at_++];
        }
        while (takeAttribute(tag)) {
        }
        if (at_ < text_.size() && (text_[at_] == '/' || text_[at_] == '?')) {
            tag.closesItself = true;
            ++at_;
        }
        if (at_ >= text_.size() || text_[at_] != '>') {
            return std::nullopt;
        }
        ++at_;
        return tag;
    }

    std::size_t position() const { return at_; }

private:
    bool takeAttribute(Tag& tag) {
        skipSpace();
        std::string name;
        while (at_ < text_.size() && (std::isalnum(static_cast<unsigned char>(text_[at_])) != 0 || text_[at_] == '_')) {
            name += text_[at_++];
        }
        if (name.empty() || at_ + 1 >= text_.size() || text_[at_] != '=') {
            return false;
        }
        const char quote = text_[at_ + 1];
        const std::size_t end = quote == '"' || quote == '\'' ? text_.find(quote, at_ + 2) : std::string_view::npos;
        if (end == std::string_view::npos) {
            return false;
        }
        std::string value(text_.substr(at_ + 2, end - at_ - 2));
        at_ = end + 1;
        return decodeEntities(value) && tag.attributes.emplace(name, value).second;
    }
    void skipSpace() {
        while (at_ < text_.size() && isSpace(text_[at_])) {
            ++at_;
        }
    }

    std::string_view text_;
    std::size_t at_ = 0;
};

template <class Number>
bool parseNumber(const std::string& text, Number& number) {
    const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    return error == std::errc() && stop == text.data() + text.size();
}

class HeadParser {
public:
    explicit HeadParser(std::string_view text) : text_(text), scan_(text) {}

    std::optional<VtuHead> parse() {
        while (const std::optional<Tag> tag = scan_.next()) {
            if (tag->name == "AppendedData") {
                return takeAppended(*tag) ? std::optional(std::move(head_)) : std::nullopt;
            }
            if (!take(*tag)) {
                break;
            }
        }
        return std::nullopt;
    }

private:
    bool take(const Tag& tag) {
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
            return ++pieces_ == 1 && parseNumber(tag.get("NumberOfPoints"), head_.points) &&
                   parseNumber(tag.get("NumberOfCells"), head_.cells);
        }
        return tag.name == "DataArray" ? takeArray(tag) : openSection(tag);
    }

    bool takeFile(const Tag& tag) {
        const std::string native = std::endian::native == std::endian::little ? "LittleEndian" : "BigEndian";
        const std::string width = tag.get("header_type", "UInt32");
        const std::string compressor = tag.get("compressor");
        head_.headerBytes = width == "UInt64" ? 8 : 4;
        head_.compression = compressor.empty()                      ? VtuHead::Compression::None
                            : compressor == "vtkZLibDataCompressor" ? VtuHead::Compression::Zlib
                                                                    : VtuHead::Compression::Lz4;
        return tag.get("type") == "UnstructuredGrid" && tag.get("byte_order") == native &&
               (width == "UInt32" || width == "UInt64") &&
               (head_.compression != VtuHead::Compression::Lz4 || compressor == "vtkLZ4DataCompressor");
    }

    bool openSection(const Tag& tag) {
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

    bool takeArray(const Tag& tag) {
        VtuArray array;
        if (!section_ || tag.get("format") != "appended" || !tag.get("TimeStep").empty() ||
            !parseNumber(tag.get("offset"), array.offset) ||
            !parseNumber(tag.get("NumberOfComponents", "1"), array.components) || array.components < 1 ||
            array.components > 1000) {
            return false;
        }
        array.name = tag.get("Name");
        array.type = tag.get("type");
        array.place = *section_;
        head_.arrays.push_back(std::move(array));
        return true;
    }

    bool takeAppended(const Tag& tag) {
        const std::string encoding = tag.get("encoding");
        head_.base64 = encoding == "base64";
        std::size_t at = scan_.position();
        while (at < text_.size() && isSpace(text_[at])) {
            ++at;
        }
        head_.dataStart = at + 1;
        return pieces_ == 1 && (encoding == "raw" || encoding == "base64") && at < text_.size() && text_[at] == '_';
    }

    std::string_view text_;
    TagScanner scan_;
    VtuHead head_;
    std::optional<VtuArray::Place> section_;
    int pieces_ = 0;
    bool inFieldData_ = false;
};

}  // namespace

std::optional<VtuHead> parseVtuHead(std::string_view text) {
    return HeadParser(text).parse();
}

}  // namespace tetralux::mesh
