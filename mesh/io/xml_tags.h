// SPDX-License-Identifier: Apache-2.0
/// \file
/// The tags of an XML file, one after the other. Files of VTK's are far too large between them for a tree.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace tetralux::mesh {

struct XmlTag {
    std::string name;  ///< "/Piece" for a closing tag
    std::map<std::string, std::string> attributes;
    bool closesItself = false;

    std::string get(const std::string& attribute, const std::string& otherwise = {}) const {
        const auto found = attributes.find(attribute);
        return found == attributes.end() ? otherwise : found->second;
    }
};

/// A file as text, a window of it at a time: what stands between tags can be gigabytes.
class FileText {
public:
    explicit FileText(int file) : file_(file) {}

    /// From `place` on, as much as a tag may be long; less only at the end of the file.
    std::string_view at(std::uint64_t place);
    /// Where the next `text` stands, if it does.
    std::optional<std::uint64_t> find(std::string_view text, std::uint64_t place);

private:
    void load(std::uint64_t place);

    int file_;
    std::string window_;
    std::uint64_t begin_ = 0;
};

/// Takes one tag after another; what stands between them, and remarks, are passed over.
class XmlTags {
public:
    /// Reads the open file `file` from its beginning.
    explicit XmlTags(int file) : file_(file) {}

    /// Nothing at the end and for what is no tag.
    std::optional<XmlTag> next();
    /// Where the last tag begins and ends, in bytes from the start of the file, and where the text before it ended: at
    /// the tag, or at a remark before it.
    std::uint64_t tagStart() const { return tagStart_; }
    std::uint64_t tagEnd() const { return position_; }
    std::uint64_t textEnd() const { return textEnd_; }
    /// The first character behind the tag that is no space, and where it stands; 0 if there is none near.
    std::pair<char, std::uint64_t> following();

private:
    bool takeAttribute(XmlTag& tag);
    void skipSpace();

    FileText file_;
    std::uint64_t position_ = 0;  ///< behind the last tag
    std::uint64_t tagStart_ = 0;
    std::uint64_t textEnd_ = 0;
    std::string_view text_;  ///< of the tag at hand, from its name on
    std::size_t at_ = 0;     ///< in it
};

}  // namespace tetralux::mesh
