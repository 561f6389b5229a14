// SPDX-License-Identifier: Apache-2.0
/// \file
/// VTK XML files whose arrays stand behind the head, raw and not compressed, each after its number of bytes.
#pragma once

#include <bit>
#include <cstdint>
#include <ostream>
#include <string>
#include <vector>

#include <fmt/format.h>

#include <mesh/tet/field.h>

namespace tetralux::mesh {

std::string escapedXml(const std::string& text);

/// The XML head. Arrays stand behind it in the order in which they are declared here.
class AppendedHead {
public:
    explicit AppendedHead(const char* type);

    void open(const std::string& text) { xml_ += text; }
    void declare(const char* type, const std::string& name, int components, std::uint64_t bytes,
                 const std::vector<std::string>& componentNames = {});
    /// Fields on points or on cells, between the tags that are asked for.
    void declareFields(const std::vector<Field>& fields, Association association);
    std::string finished(const char* type) const;

private:
    std::string xml_;
    std::uint64_t offset_ = 0;
};

inline constexpr const char* appendedTail = "\n</AppendedData>\n</VTKFile>\n";

template <class T>
void putRaw(std::ostream& out, const T* values, std::uint64_t count) {
    out.write(reinterpret_cast<const char*>(values), static_cast<std::streamsize>(count * sizeof(T)));
}

/// An array that is there.
template <class T>
void putArray(std::ostream& out, const std::vector<T>& values) {
    const std::uint64_t bytes = values.size() * sizeof(T);
    putRaw(out, &bytes, 1);
    putRaw(out, values.data(), values.size());
}

/// `count` values made by `valueAt`, in pieces, so that no second copy of the mesh is needed.
template <class T, class ValueAt>
void putMade(std::ostream& out, std::uint64_t count, const ValueAt& valueAt) {
    const std::uint64_t bytes = count * sizeof(T);
    putRaw(out, &bytes, 1);
    std::vector<T> piece;
    constexpr std::size_t pieceSize = 65536;
    for (std::uint64_t i = 0; i < count; ++i) {
        piece.push_back(static_cast<T>(valueAt(i)));
        if (piece.size() == pieceSize || i + 1 == count) {
            putRaw(out, piece.data(), piece.size());
            piece.clear();
        }
    }
}

inline void putFields(std::ostream& out, const std::vector<Field>& fields, Association association) {
    for (const Field& field : fields)
        if (field.association == association) putArray(out, field.values);
}

}  // namespace tetralux::mesh
