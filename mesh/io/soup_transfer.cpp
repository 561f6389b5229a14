// SPDX-License-Identifier: Apache-2.0
#include <mesh/io/soup_transfer.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>

#include <unistd.h>

namespace tetralux::mesh {
namespace {

constexpr std::size_t largestTransfer = std::size_t{1} << 30;  // one call moves at most 2 GiB

/// Moves all `size` bytes from or to `at` by `move(at, size)`, which is ::read or ::write of a file.
template <class Byte, class Move>
bool moveAll(Byte* at, std::size_t size, const Move& move) {
    while (size > 0) {
        const ssize_t done = move(at, std::min(size, largestTransfer));
        if (done < 0 && errno == EINTR) {
            continue;
        }
        if (done <= 0) {
            return false;
        }
        at += done;
        size -= static_cast<std::size_t>(done);
    }
    return true;
}

bool writeAll(int file, const void* data, std::size_t size) {
    return moveAll(static_cast<const char*>(data), size,
                   [file](const char* at, std::size_t count) { return ::write(file, at, count); });
}

bool readAll(int file, void* data, std::size_t size) {
    return moveAll(static_cast<char*>(data), size,
                   [file](char* at, std::size_t count) { return ::read(file, at, count); });
}

template <class Array>
bool writeArray(int file, const Array& array) {
    const std::uint64_t count = array.size();
    return writeAll(file, &count, sizeof count) && writeAll(file, array.data(), count * sizeof(array[0]));
}

template <class Array>
bool readArray(int file, Array& array) {
    std::uint64_t count = 0;
    if (!readAll(file, &count, sizeof count)) {
        return false;
    }
    array.resize(count);
    return readAll(file, array.data(), count * sizeof(array[0]));
}

bool writeStrings(int file, const std::vector<std::string>& strings) {
    const std::uint64_t count = strings.size();
    return writeAll(file, &count, sizeof count) &&
           std::all_of(strings.begin(), strings.end(),
                       [file](const std::string& text) { return writeArray(file, text); });
}

bool readStrings(int file, std::vector<std::string>& strings) {
    std::uint64_t count = 0;
    bool good = readAll(file, &count, sizeof count);
    for (std::uint64_t i = 0; good && i < count; ++i) {
        good = readArray(file, strings.emplace_back());
    }
    return good;
}

bool writeNames(int file, const std::vector<BlockName>& names) {
    std::vector<std::string> fields, texts;
    std::vector<double> numbers;
    for (const BlockName& one : names) {
        fields.push_back(one.field);
        texts.push_back(one.name);
        numbers.push_back(one.number);
    }
    return writeStrings(file, fields) && writeStrings(file, texts) && writeArray(file, numbers);
}

bool readNames(int file, std::vector<BlockName>& names) {
    std::vector<std::string> fields, texts;
    std::vector<double> numbers;
    if (!readStrings(file, fields) || !readStrings(file, texts) || !readArray(file, numbers) ||
        fields.size() != texts.size() || fields.size() != numbers.size())
        return false;
    for (std::size_t i = 0; i < fields.size(); ++i) names.push_back({fields[i], numbers[i], texts[i]});
    return true;
}

}  // namespace

bool writeSoup(int file, const CellSoup& soup) {
    bool good = writeArray(file, soup.points) && writeArray(file, soup.types) && writeArray(file, soup.offsets) &&
                writeArray(file, soup.connectivity) && writeArray(file, soup.faceOffsets) &&
                writeArray(file, soup.faceStream) && writeArray(file, soup.hidden) && writeArray(file, soup.times) &&
                writeArray(file, soup.tetrahedra) && writeStrings(file, soup.notes) &&
                writeNames(file, soup.blockNames);
    const std::uint64_t fields = soup.fields.size();
    good = good && writeAll(file, &fields, sizeof fields);
    for (const Field& field : soup.fields) {
        good = good && writeArray(file, field.name) && writeAll(file, &field.association, sizeof field.association) &&
               writeAll(file, &field.components, sizeof field.components) &&
               writeAll(file, &field.bookkeeping, sizeof field.bookkeeping) && writeArray(file, field.values) &&
               writeStrings(file, field.componentNames);
    }
    return good;
}

bool readSoup(int file, CellSoup& soup) {
    std::uint64_t fields = 0;
    bool good = readArray(file, soup.points) && readArray(file, soup.types) && readArray(file, soup.offsets) &&
                readArray(file, soup.connectivity) && readArray(file, soup.faceOffsets) &&
                readArray(file, soup.faceStream) && readArray(file, soup.hidden) && readArray(file, soup.times) &&
                readArray(file, soup.tetrahedra) && readStrings(file, soup.notes) && readNames(file, soup.blockNames) &&
                readAll(file, &fields, sizeof fields);
    for (std::uint64_t i = 0; good && i < fields; ++i) {
        Field field;
        good = readArray(file, field.name) && readAll(file, &field.association, sizeof field.association) &&
               readAll(file, &field.components, sizeof field.components) &&
               readAll(file, &field.bookkeeping, sizeof field.bookkeeping) && readArray(file, field.values) &&
               readStrings(file, field.componentNames);
        soup.fields.push_back(std::move(field));
    }
    return good;
}

}  // namespace tetralux::mesh
