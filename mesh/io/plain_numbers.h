// SPDX-License-Identifier: Apache-2.0
/// \file
/// Texts for readers that know only the finite numbers of C: what Fortran writes in its own way is written in C's, and
/// what is not finite is written as a number that stands for it until the text is read.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include <mesh/soup/cell_soup.h>

namespace tetralux::mesh {

/// Where in a text numbers stand.
struct NumberPlaces {
    bool everyWord = false;  ///< is a number, or is to be refused
    /// Lines that begin with a name or '#' hold none, or only those that cannot be anything else.
    bool inNamedLines = false;
    std::size_t firstLine = 1;  ///< number of the line that the text begins with
    std::size_t skippedLines = 0;
};

struct PlainText {
    std::string text;
    bool beyondFloat = false;  ///< some number is finite but not as a float
};

/// `text` as said above; nothing if it is so already.
/// \throws std::runtime_error naming line and word for one that is no number but should be, stars for example, or one
/// beyond those of 64 bits.
std::optional<PlainText> withPlainNumbers(std::string_view text, const NumberPlaces& places);

/// Puts back what is not finite.
void restoreNotFinite(CellSoup& soup);

/// A file that exists only in memory and has a path while this process lives.
class MemoryFile {
public:
    /// \throws std::runtime_error if the system has no room for it.
    explicit MemoryFile(std::string_view content);
    MemoryFile(const MemoryFile&) = delete;
    MemoryFile& operator=(const MemoryFile&) = delete;
    ~MemoryFile();
    std::string path() const;

private:
    int file_;
};

}  // namespace tetralux::mesh
