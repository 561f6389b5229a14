// SPDX-License-Identifier: Apache-2.0
#include <mesh/soup/append_soup.h>

#include <algorithm>
#include <limits>

#include <mesh/soup/cell_types.h>

namespace tetralux::mesh {
namespace {

constexpr double missing = std::numeric_limits<double>::quiet_NaN();

std::size_t placesOf(const CellSoup& soup, Association association) {
    return association == Association::Point ? soup.points.size() : soup.cellCount();
}

void appendFields(CellSoup& soup, CellSoup& other) {
    const auto matches = [](const Field& a, const Field& b) {
        return a.name == b.name && a.association == b.association && a.components == b.components;
    };
    for (Field& field : soup.fields) {
        const auto found =
            std::find_if(other.fields.begin(), other.fields.end(), [&](const Field& f) { return matches(f, field); });
        if (found != other.fields.end()) {
            field.values.insert(field.values.end(), found->values.begin(), found->values.end());
            other.fields.erase(found);
        } else {
            const std::size_t added = placesOf(other, field.association) * static_cast<std::size_t>(field.components);
            field.values.resize(field.values.size() + added, missing);
        }
    }
    for (Field& field : other.fields) {
        const std::size_t before = placesOf(soup, field.association) * static_cast<std::size_t>(field.components);
        field.values.insert(field.values.begin(), before, missing);
        soup.fields.push_back(std::move(field));
    }
}

std::uint32_t shifted(std::uint32_t point, const CellSoup& from, std::uint32_t shift) {
    return point >= from.points.size() ? CellSoup::invalidPoint : point + shift;
}

void appendPolyhedra(CellSoup& soup, const CellSoup& other, std::uint32_t shift) {
    if (soup.faceOffsets.empty() && other.faceOffsets.empty()) {
        return;
    }
    soup.faceOffsets.resize(soup.types.size() + 1, soup.faceStream.size());
    const std::uint64_t before = soup.faceStream.size();
    for (std::size_t cell = 0; cell < other.types.size(); ++cell) {
        const bool any = !other.faceOffsets.empty();
        soup.faceOffsets.push_back(before + (any ? other.faceOffsets[cell + 1] : 0));
    }
    soup.faceStream.insert(soup.faceStream.end(), other.faceStream.begin(), other.faceStream.end());
    for (std::uint64_t at = before; at < soup.faceStream.size();) {
        const std::uint64_t points = soup.faceStream[at++];
        for (std::uint64_t k = 0; k < points && at < soup.faceStream.size(); ++k, ++at) {
            soup.faceStream[at] = shifted(soup.faceStream[at], other, shift);
        }
    }
}

/// Of two soups that hold just tetrahedra.
void appendTetrahedra(CellSoup& soup, CellSoup&& other, std::uint32_t shift) {
    appendFields(soup, other);
    soup.tetrahedra.reserve(soup.tetrahedra.size() + other.tetrahedra.size());
    for (std::array<std::uint32_t, 4> cell : other.tetrahedra) {
        for (std::uint32_t& p : cell) {
            p = shifted(p, other, shift);
        }
        soup.tetrahedra.push_back(cell);
    }
    soup.points.insert(soup.points.end(), other.points.begin(), other.points.end());
}

}  // namespace

void preferGeneralCells(CellSoup& soup) {
    for (const std::array<std::uint32_t, 4>& cell : soup.tetrahedra) {
        appendCell(soup, cell_type::tetrahedron, cell);
    }
    soup.tetrahedra = {};
}

void appendSoup(CellSoup& soup, CellSoup&& other) {
    if (soup.points.empty() && soup.cellCount() == 0 && soup.fields.empty()) {
        other.notes.insert(other.notes.begin(), soup.notes.begin(), soup.notes.end());
        soup = std::move(other);
        return;
    }
    soup.notes.insert(soup.notes.end(), other.notes.begin(), other.notes.end());
    for (BlockName& name : other.blockNames)
        if (std::find(soup.blockNames.begin(), soup.blockNames.end(), name) == soup.blockNames.end())
            soup.blockNames.push_back(std::move(name));
    const std::uint32_t shift = static_cast<std::uint32_t>(soup.points.size());
    if (!soup.tetrahedra.empty() && !other.tetrahedra.empty()) {
        appendTetrahedra(soup, std::move(other), shift);
        return;
    }
    preferGeneralCells(soup);
    preferGeneralCells(other);
    appendFields(soup, other);
    appendPolyhedra(soup, other, shift);
    if (!soup.hidden.empty() || !other.hidden.empty()) {
        soup.hidden.resize(soup.types.size(), 0);
        other.hidden.resize(other.types.size(), 0);
        soup.hidden.insert(soup.hidden.end(), other.hidden.begin(), other.hidden.end());
    }
    if (soup.offsets.empty()) {
        soup.offsets.push_back(0);
    }
    const std::uint64_t before = soup.connectivity.size();
    for (std::size_t cell = 0; cell < other.types.size(); ++cell) {
        soup.offsets.push_back(before + other.offsets[cell + 1]);
    }
    for (const std::uint32_t p : other.connectivity) {
        soup.connectivity.push_back(shifted(p, other, shift));
    }
    soup.points.insert(soup.points.end(), other.points.begin(), other.points.end());
    soup.types.insert(soup.types.end(), other.types.begin(), other.types.end());
}

}  // namespace tetralux::mesh
