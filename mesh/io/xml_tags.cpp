// SPDX-License-Identifier: Apache-2.0
#include <mesh/io/xml_tags.h>

#include <array>
#include <cctype>
#include <cerrno>
#include <charconv>

#include <unistd.h>

namespace tetralux::mesh {
namespace {

constexpr std::size_t longestTag = 65536;

bool isSpace(char c) {
    return c == ' ' || c == '\n' || c == '\t' || c == '\r';
}

/// "&#10;" and "&#xA;", below 128, at the start of `text`. \returns its length, 0 if it is none.
std::size_t decodeNumber(std::string_view text, std::string& decoded) {
    const std::size_t end = text.find(';');
    if (!text.starts_with("&#") || end == std::string_view::npos || end < 3) {
        return 0;
    }
    const bool hex = text[2] == 'x';
    const char* const last = text.data() + end;
    unsigned code = 0;
    const auto [stop, error] = std::from_chars(text.data() + (hex ? 3 : 2), last, code, hex ? 16 : 10);
    if (error != std::errc() || stop != last || code == 0 || code > 127) {
        return 0;
    }
    decoded += static_cast<char>(code);
    return end + 1;
}

/// Replaces entities. \returns false for one that is not known.
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
        std::size_t length = decodeNumber(rest, decoded);
        for (const auto& [entity, character] : entities) {
            if (length == 0 && rest.starts_with(entity)) {
                decoded += character;
                length = entity.size();
            }
        }
        if (length == 0) {
            return false;
        }
        i += length;
    }
    text = std::move(decoded);
    return true;
}

}  // namespace

std::string_view FileText::at(std::uint64_t place) {
    if (place < begin_ || place + longestTag > begin_ + window_.size()) {
        load(place);
    }
    return std::string_view(window_).substr(static_cast<std::size_t>(place - begin_));
}

std::optional<std::uint64_t> FileText::find(std::string_view text, std::uint64_t place) {
    for (std::string_view window = at(place); window.size() >= text.size(); window = at(place)) {
        const std::size_t found = window.find(text);
        if (found != std::string_view::npos) {
            return place + found;
        }
        place += window.size() - (text.size() - 1);
    }
    return std::nullopt;
}

void FileText::load(std::uint64_t place) {
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

std::optional<XmlTag> XmlTags::next() {
    std::optional<std::uint64_t> start = file_.find("<", position_);
    textEnd_ = start.value_or(position_);
    while (start && file_.at(*start).starts_with("<!")) {  // a remark, or the kind of document
        const std::string_view end = file_.at(*start).starts_with("<!--") ? "-->" : ">";
        const std::optional<std::uint64_t> behind = file_.find(end, *start);
        start = behind ? file_.find("<", *behind) : std::nullopt;
    }
    if (!start) {
        return std::nullopt;
    }
    tagStart_ = *start;
    text_ = file_.at(tagStart_ + 1);
    at_ = 0;
    XmlTag tag;
    while (at_ < text_.size() && !isSpace(text_[at_]) && text_[at_] != '>' && (text_[at_] != '/' || tag.name.empty())) {
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

std::pair<char, std::uint64_t> XmlTags::following() {
    const std::string_view text = file_.at(position_);
    std::size_t i = 0;
    while (i < text.size() && isSpace(text[i])) {
        ++i;
    }
    return {i < text.size() ? text[i] : '\0', position_ + i};
}

bool XmlTags::takeAttribute(XmlTag& tag) {
    skipSpace();
    std::string name;
    while (at_ < text_.size() && (std::isalnum(static_cast<unsigned char>(text_[at_])) != 0 || text_[at_] == '_' ||
                                  text_[at_] == ':' || text_[at_] == '-' || text_[at_] == '.')) {
        name += text_[at_++];
    }
    skipSpace();
    if (name.empty() || at_ >= text_.size() || text_[at_] != '=') {
        return false;
    }
    ++at_;
    skipSpace();
    const char quote = at_ < text_.size() ? text_[at_] : '\0';
    const std::size_t end = quote == '"' || quote == '\'' ? text_.find(quote, at_ + 1) : std::string_view::npos;
    if (end == std::string_view::npos) {
        return false;
    }
    std::string value(text_.substr(at_ + 1, end - at_ - 1));
    at_ = end + 1;
    return decodeEntities(value) && tag.attributes.emplace(name, value).second;
}

void XmlTags::skipSpace() {
    while (at_ < text_.size() && isSpace(text_[at_])) {
        ++at_;
    }
}

}  // namespace tetralux::mesh
