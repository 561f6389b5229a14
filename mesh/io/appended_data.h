// SPDX-License-Identifier: Apache-2.0
/// \file
/// Arrays out of a VTK XML file, by many threads.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <mesh/io/vtu_head.h>

namespace tetralux::mesh {

/// A stretch of bytes of a file, as they are or in base64.
class EncodedStream {
public:
    EncodedStream(int file, std::uint64_t start, bool base64) : file_(file), start_(start), base64_(base64) {}
    /// Bytes `offset` to `offset` + `size` of the stream. \returns false if the file ends before or is no base64. Any
    /// thread may call.
    bool read(std::uint64_t offset, std::uint64_t size, char* out) const;

private:
    int file_;
    std::uint64_t start_;
    bool base64_;
};

/// One encoded array: its header is read at once, its values in pieces.
class EncodedArray {
public:
    /// \param start of the header, in bytes from the start of the file.
    /// \param elementBytes size of one value.
    EncodedArray(int file, std::uint64_t fileSize, const VtuEncoding& encoding, std::uint64_t start,
                 unsigned elementBytes);

    /// Whether the header makes sense within the file. Nothing else may be called if not.
    bool isSound() const { return sound_; }
    std::uint64_t elements() const { return bytes_ / elementBytes_; }

    /// Calls `use(first, values, count)` for all values, piece by piece, from many threads; `values` are the bytes of
    /// elements first … first + count. \returns false if a piece cannot be read or does not decompress to its size.
    bool forEachPiece(const std::function<void(std::uint64_t, const char*, std::uint64_t)>& use) const;

private:
    bool readPlainHeader();
    bool readBlockHeader();
    bool readPiece(std::size_t piece, std::vector<char>& scratch, std::vector<char>& values) const;
    std::uint64_t pieceBegin(std::size_t piece) const { return piece * pieceBytes_; }

    EncodedStream header_;
    EncodedStream data_;
    std::uint64_t fileSize_;
    unsigned headerBytes_;
    unsigned elementBytes_;
    VtuEncoding::Compression compression_;
    bool base64_;
    std::uint64_t dataOffset_ = 0;          ///< of the first piece within data_
    std::uint64_t bytes_ = 0;               ///< of all values
    std::uint64_t pieceBytes_ = 0;          ///< of the values of every piece but the last
    std::vector<std::uint64_t> blockEnds_;  ///< of compressed blocks, within data_
    bool sound_ = false;
};

/// A word of a text array that is no number, or none that its type can hold, and where in the file it begins.
struct BadWord {
    std::string word;
    std::uint64_t place = 0;
};

/// One array of numbers in plain text, of type T; otherwise as EncodedArray.
template <class T>
class TextArray {
public:
    /// The numbers stand in bytes `start` to `end` of the file. Values that fit are rounded to float if `single`.
    TextArray(int file, std::uint64_t start, std::uint64_t end, bool single = false);
    bool isSound() const { return sound_; }
    std::uint64_t elements() const { return firsts_.empty() ? 0 : firsts_.back(); }
    bool forEachPiece(const std::function<void(std::uint64_t, const char*, std::uint64_t)>& use) const;
    /// The first of all, if there is one.
    std::optional<BadWord> firstBadWord() const;

private:
    int file_;
    std::uint64_t start_, end_;
    bool single_;
    std::vector<std::uint64_t> firsts_;  ///< number of the first value of each piece of text, and of values
    bool sound_ = false;
};

}  // namespace tetralux::mesh
