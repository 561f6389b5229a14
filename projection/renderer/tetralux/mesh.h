// SPDX-License-Identifier: Apache-2.0
/// \file
/// What is drawn: tetrahedra, and values on their points or cells.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <string>

namespace tetralux {

/// An axis-aligned box.
struct BoundingBox {
    std::array<double, 3> low{};   ///< mesh units
    std::array<double, 3> high{};  ///< mesh units
    double diagonal() const;       ///< its length, mesh units
};

/// What checking found. Nothing in it is an error: what is counted was left out or mended, and the rest is drawn.
struct MeshReport {
    std::uint64_t cellsRead = 0;                     ///< of any type
    std::map<std::string, std::uint64_t> cellTypes;  ///< cells by type name
    std::map<std::string, std::uint64_t> defects;    ///< by name: "inverted cell", "duplicate cell", …
    std::map<std::string, std::uint64_t> skipped;    ///< cells left out, by reason
};

/// Checked tetrahedra, never changed, shared by renderers and threads: what takes long to find out about a mesh
/// (adjacency, the certificate of its visibility order) is found once and kept with it.
class Mesh {
public:
    /// `xyz`: three coordinates a point, in mesh units. `cells`: four point numbers a tetrahedron, in any orientation.
    /// Tetrahedra that are flat, twice there, out of range or have a coordinate that is not finite are left out and
    /// counted in `report`. \throws Error (BadInput) if the arrays do not fit together or nothing is left to draw.
    static std::shared_ptr<const Mesh> fromTetrahedra(std::span<const double> xyz, std::span<const std::uint32_t> cells,
                                                      MeshReport* report = nullptr);
    /// The same with float points.
    static std::shared_ptr<const Mesh> fromTetrahedra(std::span<const float> xyz, std::span<const std::uint32_t> cells,
                                                      MeshReport* report = nullptr);

    /// The same without a copy of the points: they stay where they are and must not change while `owner` lives, which
    /// the mesh keeps alive. (Points that no sound tetrahedron uses may stay; they are not drawn.) `cells` are borrowed
    /// too where all of them are sound and positively oriented: det(b − a, c − a, d − a) > 0.
    static std::shared_ptr<const Mesh> borrow(std::span<const double> xyz, std::span<const std::uint32_t> cells,
                                              std::shared_ptr<const void> owner, MeshReport* report = nullptr);

    /// Cells of any type, in VTK's numbering of types and of points within a cell: mixed, quadratic and Lagrange,
    /// polyhedra (`faceOffsets` and `faceStream` as described below; else empty). Cell i has the points
    /// connectivity[offsets[i] … offsets[i + 1]), so there is one offset more than there are types. A polyhedron i has
    /// faceStream[faceOffsets[i] … faceOffsets[i + 1]): for each of its faces the number of points, then these.
    static std::shared_ptr<const Mesh> fromCells(std::span<const double> xyz, std::span<const std::uint8_t> types,
                                                 std::span<const std::int64_t> offsets,
                                                 std::span<const std::int64_t> connectivity,
                                                 MeshReport* report = nullptr,
                                                 std::span<const std::int64_t> faceOffsets = {},
                                                 std::span<const std::int64_t> faceStream = {});
    /// The same with float points, which are converted.
    static std::shared_ptr<const Mesh> fromCells(std::span<const float> xyz, std::span<const std::uint8_t> types,
                                                 std::span<const std::int64_t> offsets,
                                                 std::span<const std::int64_t> connectivity,
                                                 MeshReport* report = nullptr,
                                                 std::span<const std::int64_t> faceOffsets = {},
                                                 std::span<const std::int64_t> faceStream = {});
    /// The same with 32-bit numbers.
    static std::shared_ptr<const Mesh> fromCells(std::span<const double> xyz, std::span<const std::uint8_t> types,
                                                 std::span<const std::int32_t> offsets,
                                                 std::span<const std::int32_t> connectivity,
                                                 MeshReport* report = nullptr);

    ~Mesh();
    Mesh(const Mesh&) = delete;
    Mesh& operator=(const Mesh&) = delete;

    std::size_t tetrahedra() const;  ///< that are drawn
    BoundingBox bounds() const;      ///< of them

    std::span<const double> positions() const;       ///< three coordinates a point, as drawn, while the mesh lives
    std::span<const std::uint32_t> corners() const;  ///< four points a tetrahedron, likewise

    std::size_t points() const;  ///< of the arrays that it was made of: as many values has a field on points
    std::size_t cells() const;   ///< likewise, and a field on cells

    struct Data;                                 ///< the library's own
    explicit Mesh(std::unique_ptr<Data> data);   ///< the library's own
    const Data& data() const { return *data_; }  ///< the library's own

private:
    std::unique_ptr<Data> data_;
};

/// One finite number on each point or each cell of a mesh's arrays; cells where one is NaN, infinite or beyond 1e280
/// are not drawn, and counted in FrameResult.
class Field {
public:
    static Field onPoints(std::span<const double> values);  ///< linear within each tetrahedron; values are copied
    static Field onPoints(std::span<const float> values);   ///< likewise
    static Field onCells(std::span<const double> values);   ///< constant within each cell
    static Field onCells(std::span<const float> values);    ///< likewise
    /// Without a copy: `values` must not change while `owner` lives, which the field keeps alive.
    static Field borrowOnPoints(std::span<const double> values, std::shared_ptr<const void> owner);
    /// Likewise.
    static Field borrowOnCells(std::span<const double> values, std::shared_ptr<const void> owner);

    bool isOnPoints() const { return onPoints_; }                        ///< else on cells
    std::span<const double> values() const { return values_; }           ///< one for each
    const std::shared_ptr<const void>& owner() const { return owner_; }  ///< what keeps the values alive

private:
    Field(bool onPoints, std::span<const double> values, std::shared_ptr<const void> owner);

    bool onPoints_ = true;
    std::span<const double> values_;
    std::shared_ptr<const void> owner_;
};

}  // namespace tetralux
