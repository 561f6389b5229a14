// SPDX-License-Identifier: Apache-2.0
#include <mesh/io/vtu_head.h>

#include <array>
#include <bit>
#include <cctype>
#include <cerrno>
#include <charconv>
#include <map>
#include <string_view>
#include <utility>

#include <unistd.h>

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

/// A file as text, a window of it at a time: what stands between tags can be gigabytes.
class FileText {
public:
    explicit FileText(int file) : file_(file) {}

    /// From `place` on, as much as a tag may be long; less only at the end of the file.
    std::string_view at(std::uint64_t place) {
        if (place < begin_ || place + longestTag > begin_ + window_.size()) {
            load(place);
        }
        return std::string_view(window_).substr(static_cast<std::size_t>(place - begin_));
    }
    /// Where the next `character` stands, if one does.
    std::optional<std::uint64_t> find(char character, std::uint64_t place) {
        for (std::string_view text = at(place); !text.empty(); text = at(place)) {
            const std::size_t found = text.find(character);
            if (found != std::string_view::npos) {
                return place + found;
            }
            place += text.size();
        }
        return std::nullopt;
    }

private:
    static constexpr std::size_t longestTag = 65536;

    void load(std::uint64_t place) {
        window_.resize(16 * longestTag);
        std::size_t size = 0;
        while (size < window_.size()) {
            const ssize_t got =
                ::pread(file_, window_.data() + size, window_.size() - size, static_cast<off_t>(place + size));
            if (got < 0 && errno == EINTR) {
                continue;
            }
            if (got <= 0) {
                break;
            }
            size += static_cast<std::size_t>(got);
        }
        window_.resize(size);
        begin_ = place;
    }

    int file_;
    std::string window_;
    std::uint64_t begin_ = 0;
};

/// Takes one tag after another; what stands between them is passed over.
class TagScanner {
public:
    explicit TagScanner(int file) : file_(file) {}

    std::optional<Tag> next() {
        const std::optional<std::uint64_t> start = file_.find('<', position_);
        if (!start) {
            return std::nullopt;
        }
        tagStart_ = *start;
        text_ = file_.at(tagStart_ + 1);
        at_ = 0;
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
        position_ = tagStart_ + 1 + at_;
        return tag;
    }

    std::uint64_t tagStart() const { return tagStart_; }
    /// The first character behind the tag that is no space, and where it stands; 0 if there is none near.
    std::pair<char, std::uint64_t> following() {
        const std::string_view text = file_.at(position_);
        std::size_t i = 0;
        while (i < text.size() && isSpace(text[i])) {
            ++i;
        }
        return {i < text.size() ? text[i] : '\0', position_ + i};
    }

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

    FileText file_;
    std::uint64_t position_ = 0;  ///< behind the last tag
    std::uint64_t tagStart_ = 0;
    std::string_view text_;  ///< of the tag at hand, from its name on
    std::size_t at_ = 0;     ///< in it
};

template <class Number>
bool parseNumber(const std::string& text, Number& number) {
    const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    return error == std::errc() && stop == text.data() + text.size();
}

class HeadParser {
public:
    explicit HeadParser(int file) : scan_(file) {}

    std::optional<VtuHead> parse() {
        while (const std::optional<Tag> tag = scan_.next()) {
            if (tag->name == "AppendedData") {
                return takeAppended(*tag) ? std::optional(std::move(head_)) : std::nullopt;
            }
            if (tag->name == "/VTKFile") {
                return pieces_ == 1 && !anyAppended_ ? std::optional(std::move(head_)) : std::nullopt;
            }
            if (!take(*tag)) {
                break;
            }
        }
        return std::nullopt;
    }

private:
    bool take(const Tag& tag) {
        if (arrayIsOpen_) {  // numbers end where VTK's further remarks begin
            head_.arrays.back().end = scan_.tagStart();
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
            return ++pieces_ == 1 && parseNumber(tag.get("NumberOfPoints"), head_.points) &&
                   parseNumber(tag.get("NumberOfCells"), head_.cells);
        }
        return tag.name == "DataArray" ? takeArray(tag) : openSection(tag);
    }

    bool takeFile(const Tag& tag) {
        const std::string native = std::endian::native == std::endian::little ? "LittleEndian" : "BigEndian";
        const std::string width = tag.get("header_type", "UInt32");
        const std::string compressor = tag.get("compressor");
        head_.encoding.headerBytes = width == "UInt64" ? 8 : 4;
        using Compression = VtuEncoding::Compression;
        head_.encoding.compression = compressor.empty()                      ? Compression::None
                                     : compressor == "vtkZLibDataCompressor" ? Compression::Zlib
                                                                             : Compression::Lz4;
        return tag.get("type") == "UnstructuredGrid" && tag.get("byte_order") == native &&
               (width == "UInt32" || width == "UInt64") &&
               (head_.encoding.compression != Compression::Lz4 || compressor == "vtkLZ4DataCompressor");
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
        const std::string format = tag.get("format");
        if (!section_ || !tag.get("TimeStep").empty() ||
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
            if (tag.closesItself || (format != "ascii" && format != "binary")) {
                return false;
            }
        }
        arrayIsOpen_ = !tag.closesItself;
        array.name = tag.get("Name");
        array.type = tag.get("type");
        array.place = *section_;
        head_.arrays.push_back(std::move(array));
        return true;
    }

    bool takeAppended(const Tag& tag) {
        const std::string encoding = tag.get("encoding");
        head_.encoding.base64 = encoding == "base64";
        const auto [first, place] = scan_.following();
        head_.dataStart = place + 1;
        return pieces_ == 1 && (encoding == "raw" || encoding == "base64") && first == '_';
    }

    TagScanner scan_;
    VtuHead head_;
    std::optional<VtuArray::Place> section_;
    int pieces_ = 0;
    bool inFieldData_ = false;
    bool anyAppended_ = false;
    bool arrayIsOpen_ = false;
};

}  // namespace

std::optional<VtuHead> parseVtuHead(int file) {
    return HeadParser(file).parse();
}

}  // namespace tetralux::mesh
