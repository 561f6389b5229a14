// SPDX-License-Identifier: Apache-2.0
/// \file
/// Polygonal faces cut into triangles so that the two cells on either side of a face cut it alike.
///
/// A convex polygon is a fan about its smallest point number (Dompierre, Labbé, Vallet & Camarero 1999, "How to
/// subdivide pyramids, prisms and hexahedra into tetrahedra"). Two departures: where other cells put two triangles
/// against a quadrilateral, it is cut along their diagonal; where a polygon is not convex, the fan is about the
/// smallest number from which no triangle of it turns back.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <span>
#include <unordered_set>
#include <vector>

#include <mesh/soup/cell_soup.h>
#include <mesh/soup/cell_types.h>
#include <mesh/soup/soup_checks.h>

namespace tetralux::mesh {

using Triangle = std::array<std::uint32_t, 3>;

class FaceTriangulation {
public:
    /// Looks through the kept cells for triangles that may lie against quadrilaterals. Refers to `soup` from then on.
    FaceTriangulation(const CellSoup& soup, const std::vector<CellVerdict>& verdicts);

    /// Appends the triangles of `polygon` (point numbers in range, none twice in succession) to `out`, turning the
    /// same way round as it. The cut depends on the set of points, not on where or which way round the list starts.
    void cut(std::span<const std::uint32_t> polygon, std::vector<Triangle>& out) const;

    /// How many quadrilaterals have been cut as triangles on their other side are.
    std::uint64_t facesFitted() const { return facesFitted_; }

private:
    bool isInterfaceTriangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) const;
    std::size_t fanRoot(std::span<const std::uint32_t> canonical) const;

    struct TriangleHash {
        std::size_t operator()(const Triangle& t) const {
            return ((t[0] * 0x9e3779b97f4a7c15ull + t[1]) * 0x9e3779b97f4a7c15ull + t[2]) * 0x9e3779b97f4a7c15ull >> 16;
        }
    };

    const std::vector<glm::dvec3>& points_;
    std::unordered_set<Triangle, TriangleHash> interface_;  ///< sorted triples
    mutable std::atomic<std::uint64_t> facesFitted_{0};
};

/// Calls `visit(face)` with the point numbers of every face of `cell`, a span valid during the call.
template <class Visit>
void forEachFace(const CellSoup& soup, std::size_t cell, const Visit& visit) {
    if (soup.types[cell] == cell_type::polyhedron) {
        const std::span<const std::uint32_t> stream(soup.faceStream);
        for (std::uint64_t at = soup.faceOffsets[cell]; at < soup.faceOffsets[cell + 1]; at += stream[at] + 1) {
            visit(stream.subspan(at + 1, stream[at]));
        }
        return;
    }
    std::array<std::uint32_t, 6> face{};
    for (const std::span<const std::uint8_t> local : linearCellFaces(soup.types[cell])) {
        for (std::size_t k = 0; k < local.size(); ++k) {
            face[k] = soup.connectivity[soup.offsets[cell] + local[k]];
        }
        visit(std::span<const std::uint32_t>(face.data(), local.size()));
    }
}

}  // namespace tetralux::mesh
