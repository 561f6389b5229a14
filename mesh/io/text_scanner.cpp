// SPDX-License-Identifier: Apache-2.0
#include <mesh/io/text_scanner.h>

#include <algorithm>
#include <charconv>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include <fmt/format.h>

#include <mesh/io/file_checks.h>
#include <mesh/io/number_text.h>

namespace tetralux::mesh {
namespace {

bool isSpace(char c) {
    return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\f' || c == '\v';
}

}  // namespace

void TextScanner::fail(const std::string& what) const {
    refuse(what, "the file is probably truncated or damaged: write it again");
}

void TextScanner::refuse(const std::string& what, const char* remedy) const {
    const auto line = 1 + std::count(text_.begin(), text_.begin() + static_cast<std::ptrdiff_t>(at_), '\n');
    throw std::runtime_error(fmt::format("{}: line {}: {}; {}", source_, line, what, remedy));
}

bool TextScanner::atEnd() {
    while (at_ < text_.size()) {
        if (comment_ != '\0' && text_[at_] == comment_) {
            restOfLine();
        } else if (isSpace(text_[at_])) {
            ++at_;
        } else {
            return false;
        }
    }
    return true;
}

std::string_view TextScanner::peek() {
    if (atEnd()) {
        return {};
    }
    std::size_t end = at_;
    while (end < text_.size() && !isSpace(text_[end]) && (comment_ == '\0' || text_[end] != comment_)) {
        ++end;
    }
    return text_.substr(at_, end - at_);
}

std::string_view TextScanner::word(const char* what) {
    const std::string_view found = peek();
    if (found.empty()) {
        fail(fmt::format("ends where {} should stand", what));
    }
    at_ += found.size();
    return found;
}

double TextScanner::number(const char* what) {
    const std::string_view text = word(what);
    double value = 0.0;
    if (const NumberText kind = parseNumber(text, value); kind != NumberText::Good) {
        at_ -= text.size();  // the line is that of the word
        refuse(complaintOf(text, kind, what), remedyFor(text, kind));
    }
    return value;
}

std::int64_t TextScanner::integer(const char* what) {
    const std::string_view text = word(what);
    const std::string_view digits = text.starts_with('+') ? text.substr(1) : text;
    std::int64_t value = 0;
    const auto [stop, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (error != std::errc() || stop != digits.data() + digits.size()) {
        at_ -= text.size();
        refuse(fmt::format("'{}' stands where {} should", shownWord(text), what), "write a whole number there");
    }
    return value;
}

std::size_t TextScanner::count(const char* what, std::size_t bytesEach) {
    const std::int64_t value = integer(what);
    if (value < 0 || static_cast<std::uint64_t>(value) > remaining() / bytesEach) {
        fail(fmt::format("{} is {}, but the file is too short for that", what, value));
    }
    return static_cast<std::size_t>(value);
}

std::string_view TextScanner::restOfLine() {
    const std::size_t end = std::min(text_.find('\n', at_), text_.size());
    std::string_view line = text_.substr(at_, end - at_);
    at_ = std::min(end + 1, text_.size());
    if (!line.empty() && line.back() == '\r') {
        line.remove_suffix(1);
    }
    return line;
}

bool TextScanner::skipPast(std::string_view text) {
    const std::size_t found = text_.find(text, at_);
    at_ = found == std::string_view::npos ? text_.size() : found + text.size();
    return found != std::string_view::npos;
}

std::string_view TextScanner::bytes(std::size_t size, const char* what) {
    if (size > remaining()) {
        fail(fmt::format("ends within {}", what));
    }
    const std::string_view found = text_.substr(at_, size);
    at_ += size;
    return found;
}

std::string readWholeFile(const std::string& path) {
    checkReadable(path);
    std::ifstream in(path, std::ios::binary);
    std::ostringstream content;
    content << in.rdbuf();
    if (!in || !content) {
        throw std::runtime_error(fmt::format("{}: could not be read to the end; copy it to a sound disk", path));
    }
    return std::move(content).str();
}

}  // namespace tetralux::mesh
