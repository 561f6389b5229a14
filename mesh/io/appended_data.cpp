// SPDX-License-Identifier: Apache-2.0
#include <mesh/io/appended_data.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>
#include <memory>
#include <string_view>
#include <type_traits>

#include <libdeflate.h>
#include <lz4.h>
#include <tbb/parallel_for.h>
#include <unistd.h>

#include <mesh/io/number_text.h>

namespace tetralux::mesh {
namespace {

bool readAt(int file, std::uint64_t place, std::uint64_t size, char* out) {
    while (size > 0) {
        const ssize_t done = ::pread(file, out, std::min<std::uint64_t>(size, 1u << 30), static_cast<off_t>(place));
        if (done < 0 && errno == EINTR) {
            continue;
        }
        if (done <= 0) {
            return false;
        }
        out += done;
        place += static_cast<std::uint64_t>(done);
        size -= static_cast<std::uint64_t>(done);
    }
    return true;
}

constexpr std::uint8_t notBase64 = 0xff;

constexpr std::array<std::uint8_t, 256> makeSixBits() {
    std::array<std::uint8_t, 256> table{};
    table.fill(notBase64);
    const char* const alphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (std::uint8_t i = 0; i < 64; ++i) {
        table[static_cast<std::uint8_t>(alphabet[i])] = i;
    }
    table['='] = 0;  // padding: the bytes it stands for are never asked for
    return table;
}

/// `groups` groups of four characters to three bytes each.
bool decodeBase64(const char* text, std::uint64_t groups, char* out) {
    static constexpr std::array<std::uint8_t, 256> sixBits = makeSixBits();
    std::uint8_t seen = 0;
    for (std::uint64_t i = 0; i < groups; ++i, text += 4, out += 3) {
        const std::uint8_t a = sixBits[static_cast<std::uint8_t>(text[0])];
        const std::uint8_t b = sixBits[static_cast<std::uint8_t>(text[1])];
        const std::uint8_t c = sixBits[static_cast<std::uint8_t>(text[2])];
        const std::uint8_t d = sixBits[static_cast<std::uint8_t>(text[3])];
        seen = static_cast<std::uint8_t>(seen | a | b | c | d);
        out[0] = static_cast<char>(a << 2 | b >> 4);
        out[1] = static_cast<char>(b << 4 | c >> 2);
        out[2] = static_cast<char>(c << 6 | d);
    }
    return (seen & 0xc0) == 0;
}

/// What libdeflate needs to work with; two to three times as fast as zlib.
class Inflater {
public:
    bool decompress(const std::vector<char>& block, std::vector<char>& values) const {
        return state_ != nullptr && libdeflate_zlib_decompress(state_.get(), block.data(), block.size(), values.data(),
                                                               values.size(), nullptr) == LIBDEFLATE_SUCCESS;
    }

private:
    std::unique_ptr<libdeflate_decompressor, void (*)(libdeflate_decompressor*)> state_{libdeflate_alloc_decompressor(),
                                                                                        &libdeflate_free_decompressor};
};

bool decompress(VtuEncoding::Compression compression, const std::vector<char>& block, std::vector<char>& values) {
    if (compression == VtuEncoding::Compression::Zlib) {
        thread_local const Inflater inflater;
        return inflater.decompress(block, values);
    }
    return LZ4_decompress_safe(block.data(), values.data(), static_cast<int>(block.size()),
                               static_cast<int>(values.size())) == static_cast<int>(values.size());
}

bool isSpace(char c) {
    return c == ' ' || c == '\n' || c == '\t' || c == '\r';
}

constexpr std::uint64_t textPiece = 1u << 20;
constexpr std::uint64_t longestWord = 512;

struct Words {
    std::string_view text;
    std::uint64_t place = 0;  ///< of its first byte in the file
};

/// The words that begin in piece `piece` of the text from `start` to `end`. Valid until the thread's next call.
/// \returns false if the file ends before, or a word is longer than any number.
bool readWords(int file, std::uint64_t start, std::uint64_t end, std::size_t piece, Words& words) {
    const std::uint64_t first = start + piece * textPiece;
    const std::uint64_t before = first > start ? first - 1 : first;  // to tell whether a word began there
    const std::uint64_t nominal = std::min(end, first + textPiece);
    const std::uint64_t last = std::min(end, nominal + longestWord);
    thread_local std::vector<char> bytes;
    bytes.resize(static_cast<std::size_t>(last - before));
    if (!readAt(file, before, bytes.size(), bytes.data())) {
        return false;
    }
    std::size_t from = 0;
    while (first > start && from < bytes.size() && !isSpace(bytes[from])) {
        ++from;
    }
    std::size_t to = static_cast<std::size_t>(nominal - before);
    while (to > 0 && to < bytes.size() && !isSpace(bytes[to - 1]) && !isSpace(bytes[to])) {
        ++to;
    }
    words = {from < to ? std::string_view(bytes.data() + from, to - from) : std::string_view(), before + from};
    return to < bytes.size() || last == end;
}

/// The number that a text begins with. \returns where it ends, nullptr if there is none that T holds.
template <class T>
const char* parseWord(const char* at, const char* end, bool single, T& value) {
    if constexpr (std::is_floating_point_v<T>) {
        auto [stop, error] = std::from_chars(at, end, value);
        if (error != std::errc() || (stop != end && !isSpace(*stop))) {
            stop = std::find_if(at, end, isSpace);
            if (parseNumber(std::string_view(at, static_cast<std::size_t>(stop - at)), value) != NumberText::Good) {
                return nullptr;
            }
        }
        const T largest = std::numeric_limits<float>::max();
        value = single && std::abs(value) <= largest ? static_cast<float>(value) : value;
        return stop;
    } else {
        // Bytes are numbers in these files, not characters.
        std::conditional_t<sizeof(T) == 1, int, T> number{};
        const auto [stop, error] = std::from_chars(at + (*at == '+' ? 1 : 0), end, number);
        value = static_cast<T>(number);
        return error == std::errc() && (stop == end || isSpace(*stop)) && value == number ? stop : nullptr;
    }
}

/// Parses as many numbers as `values` has room for. \returns the word that is none, or nullptr.
template <class T>
const char* parseWords(std::string_view text, bool single, std::vector<T>& values) {
    const char* at = text.data();
    const char* const end = at + text.size();
    for (T& value : values) {
        while (at != end && isSpace(*at)) {
            ++at;
        }
        const char* const stop = at == end ? nullptr : parseWord(at, end, single, value);
        if (stop == nullptr) {
            return at;
        }
        at = stop;
    }
    return nullptr;
}

}  // namespace

bool EncodedStream::read(std::uint64_t offset, std::uint64_t size, char* out) const {
    if (!base64_) {
        return readAt(file_, start_ + offset, size, out);
    }
    const std::uint64_t firstGroup = offset / 3;
    const std::uint64_t groups = (offset + size + 2) / 3 - firstGroup;
    thread_local std::vector<char> text;
    thread_local std::vector<char> bytes;
    text.resize(4 * groups);
    bytes.resize(3 * groups);
    if (!readAt(file_, start_ + 4 * firstGroup, text.size(), text.data()) ||
        !decodeBase64(text.data(), groups, bytes.data())) {
        return false;
    }
    std::memcpy(out, bytes.data() + (offset - 3 * firstGroup), size);
    return true;
}

EncodedArray::EncodedArray(int file, std::uint64_t fileSize, const VtuEncoding& encoding, std::uint64_t start,
                           unsigned elementBytes)
    : header_(file, start, encoding.base64),
      data_(header_),
      fileSize_(fileSize),
      headerBytes_(encoding.headerBytes),
      elementBytes_(elementBytes),
      compression_(encoding.compression),
      base64_(encoding.base64) {
    if (start > fileSize) {
        return;
    }
    const bool plain = compression_ == VtuEncoding::Compression::None;
    sound_ = (plain ? readPlainHeader() : readBlockHeader()) && bytes_ % elementBytes_ == 0 &&
             pieceBytes_ % elementBytes_ == 0;
    if (sound_ && !plain) {
        const std::uint64_t headerSize = (3 + blockEnds_.size()) * headerBytes_;
        const std::uint64_t encoded = base64_ ? (headerSize + 2) / 3 * 4 : headerSize;
        data_ = EncodedStream(file, start + encoded, base64_);
    }
}

bool EncodedArray::readPlainHeader() {
    if (!header_.read(0, headerBytes_, reinterpret_cast<char*>(&bytes_))) {
        return false;
    }
    dataOffset_ = headerBytes_;
    pieceBytes_ = 24 * 32768;  // whole values of any size, and whole groups of base64
    return bytes_ <= fileSize_;
}

/// Number of blocks, bytes of a block, bytes of the last if it is shorter, compressed size of each block.
bool EncodedArray::readBlockHeader() {
    std::array<std::uint64_t, 3> numbers{};
    for (std::size_t i = 0; i < 3; ++i) {
        if (!header_.read(i * headerBytes_, headerBytes_, reinterpret_cast<char*>(&numbers[i]))) {
            return false;
        }
    }
    const auto [blocks, blockBytes, lastBytes] = numbers;
    constexpr std::uint64_t largestBlock = 1u << 30;
    if (blocks > fileSize_ / headerBytes_ || blockBytes > largestBlock || lastBytes > blockBytes) {
        return false;
    }
    std::vector<char> sizes(blocks * headerBytes_);
    if (!header_.read(3 * headerBytes_, sizes.size(), sizes.data())) {
        return false;
    }
    std::uint64_t end = 0;
    for (std::size_t i = 0; i < blocks; ++i) {
        std::uint64_t size = 0;
        std::memcpy(&size, sizes.data() + i * headerBytes_, headerBytes_);
        if (size > fileSize_) {
            return false;
        }
        end += size;
        blockEnds_.push_back(end);
    }
    constexpr std::uint64_t largestRatio = 1100;  // of deflate; a file that claims more is damaged
    pieceBytes_ = std::max<std::uint64_t>(blockBytes, elementBytes_);
    bytes_ = blocks == 0 ? 0 : lastBytes == 0 ? blocks * blockBytes : (blocks - 1) * blockBytes + lastBytes;
    return end <= fileSize_ && bytes_ / largestRatio <= fileSize_;
}

bool EncodedArray::readPiece(std::size_t piece, std::vector<char>& scratch, std::vector<char>& values) const {
    const std::uint64_t begin = pieceBegin(piece);
    values.resize(std::min(bytes_ - begin, pieceBytes_));
    if (compression_ == VtuEncoding::Compression::None) {
        return data_.read(dataOffset_ + begin, values.size(), values.data());
    }
    const std::uint64_t blockBegin = piece == 0 ? 0 : blockEnds_[piece - 1];
    scratch.resize(blockEnds_[piece] - blockBegin);
    return data_.read(blockBegin, scratch.size(), scratch.data()) && decompress(compression_, scratch, values);
}

bool EncodedArray::forEachPiece(const std::function<void(std::uint64_t, const char*, std::uint64_t)>& use) const {
    const std::size_t pieces = bytes_ == 0 ? 0 : static_cast<std::size_t>((bytes_ + pieceBytes_ - 1) / pieceBytes_);
    std::atomic<bool> good = true;
    tbb::parallel_for(std::size_t{0}, pieces, [&](std::size_t piece) {
        thread_local std::vector<char> scratch;
        thread_local std::vector<char> values;
        if (good.load(std::memory_order_relaxed) && readPiece(piece, scratch, values)) {
            use(pieceBegin(piece) / elementBytes_, values.data(), values.size() / elementBytes_);
        } else {
            good.store(false, std::memory_order_relaxed);
        }
    });
    return good;
}

template <class T>
TextArray<T>::TextArray(int file, std::uint64_t start, std::uint64_t end, bool single)
    : file_(file), start_(start), end_(end), single_(single) {
    const std::size_t pieces = static_cast<std::size_t>((end - start + textPiece - 1) / textPiece);
    firsts_.assign(pieces + 1, 0);
    std::atomic<bool> good = true;
    tbb::parallel_for(std::size_t{0}, pieces, [&](std::size_t piece) {
        Words words;
        if (!readWords(file_, start_, end_, piece, words)) {
            good.store(false, std::memory_order_relaxed);
        }
        std::uint64_t count = 0;
        bool before = true;  // a space
        for (const char c : words.text) {
            const bool space = isSpace(c);
            count += before && !space ? 1 : 0;
            before = space;
        }
        firsts_[piece + 1] = count;
    });
    for (std::size_t piece = 0; piece < pieces; ++piece) {
        firsts_[piece + 1] += firsts_[piece];
    }
    sound_ = good;
}

template <class T>
bool TextArray<T>::forEachPiece(const std::function<void(std::uint64_t, const char*, std::uint64_t)>& use) const {
    std::atomic<bool> good = true;
    tbb::parallel_for(std::size_t{0}, firsts_.size() - 1, [&](std::size_t piece) {
        thread_local std::vector<T> values;
        Words words;
        values.resize(static_cast<std::size_t>(firsts_[piece + 1] - firsts_[piece]));
        if (good.load(std::memory_order_relaxed) && readWords(file_, start_, end_, piece, words) &&
            parseWords(words.text, single_, values) == nullptr) {
            use(firsts_[piece], reinterpret_cast<const char*>(values.data()), values.size());
        } else {
            good.store(false, std::memory_order_relaxed);
        }
    });
    return good;
}

template <class T>
std::optional<BadWord> TextArray<T>::firstBadWord() const {
    std::vector<T> values;
    for (std::size_t piece = 0; piece + 1 < firsts_.size(); ++piece) {
        Words words;
        values.resize(static_cast<std::size_t>(firsts_[piece + 1] - firsts_[piece]));
        if (!readWords(file_, start_, end_, piece, words)) {
            break;
        }
        if (const char* const bad = parseWords(words.text, single_, values); bad != nullptr) {
            const char* const last = words.text.data() + words.text.size();
            return BadWord{std::string(bad, std::find_if(bad, last, isSpace)),
                           words.place + static_cast<std::uint64_t>(bad - words.text.data())};
        }
    }
    return std::nullopt;
}

template class TextArray<double>;
template class TextArray<std::int64_t>;
template class TextArray<std::int32_t>;
template class TextArray<std::int16_t>;
template class TextArray<std::int8_t>;
template class TextArray<std::uint64_t>;
template class TextArray<std::uint32_t>;
template class TextArray<std::uint16_t>;
template class TextArray<std::uint8_t>;

}  // namespace tetralux::mesh
