// SPDX-License-Identifier: Apache-2.0
/// \file
/// Words and numbers out of a text that may be anything.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

namespace tetralux::mesh {

/// Walks over a text. Every function that finds something else than it was asked for throws a std::runtime_error that
/// names `source` and the line, and ends with a remedy.
class TextScanner {
public:
    /// `comment` starts a comment that ends with its line; '\0' if there are none. `text` must outlive the scanner.
    TextScanner(std::string_view text, std::string source, char comment)
        : text_(text), source_(std::move(source)), comment_(comment) {}

    /// Skips white space and comments. \returns whether nothing follows.
    bool atEnd();
    /// The next word; `what` names it in the error when there is none.
    std::string_view word(const char* what);
    /// The next word without taking it; empty at the end.
    std::string_view peek();
    double number(const char* what);
    std::int64_t integer(const char* what);
    /// A number of things that follow, each at least `bytesEach` bytes long: refused when the text is too short for
    /// them.
    std::size_t count(const char* what, std::size_t bytesEach);
    /// The rest of the line, without its end.
    std::string_view restOfLine();
    /// Moves behind the next occurrence of `text`. \returns whether there was one.
    bool skipPast(std::string_view text);

    std::size_t position() const { return at_; }
    std::size_t remaining() const { return text_.size() - at_; }
    /// Bytes of a binary part: `size` of them, taken. Refused when fewer are left.
    std::string_view bytes(std::size_t size, const char* what);

    [[noreturn]] void fail(const std::string& what) const;
    /// As `fail`, for a file that is sound but beyond us: the remedy is the caller's.
    [[noreturn]] void refuse(const std::string& what, const char* remedy) const;

private:
    std::string_view text_;
    std::string source_;
    char comment_;
    std::size_t at_ = 0;
};

/// The next value of a binary part, its bytes exchanged if `swap`.
template <class T>
T takeBinary(TextScanner& scan, bool swap, const char* what) {
    std::array<char, sizeof(T)> raw;
    std::memcpy(raw.data(), scan.bytes(sizeof(T), what).data(), sizeof(T));
    if (swap) {
        std::reverse(raw.begin(), raw.end());
    }
    return std::bit_cast<T>(raw);
}

/// Everything in the file. \throws std::runtime_error naming it.
std::string readWholeFile(const std::string& path);

}  // namespace tetralux::mesh
