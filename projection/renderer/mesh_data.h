// SPDX-License-Identifier: Apache-2.0
/// \file
/// Internal: what stands behind the public Mesh, Field and TransferFunction.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include <mesh/soup/cell_soup.h>
#include <mesh/tet/mesh_report.h>
#include <mesh/tet/tet_mesh.h>
#include <preint/transfer_function.h>
#include <projection/core/kept.h>
#include <tetralux/appearance.h>
#include <tetralux/mesh.h>

namespace tetralux {

struct Mesh::Data {
    mesh::SharedArray<glm::dvec3> positions;
    mesh::SharedArray<mesh::Tetrahedron> cells;
    mesh::BoundingBox bounds;
    std::size_t sourcePoints = 0, sourceCells = 0;  ///< of the arrays that it was made of
    /// Where values come from: source point of each point, source cell of each tetrahedron. Empty: the same number.
    std::vector<std::uint32_t> pointOf, cellOf;
    /// The source itself, where it has curved cells: the values at the corners of their pieces are not its points'.
    std::optional<mesh::CellSoup> curved;
    std::shared_ptr<projection::MeshMemo> memo = std::make_shared<projection::MeshMemo>();
};

struct TransferFunction::Data {
    preint::TransferFunction function;
};

namespace renderer {

/// What engines draw: the mesh with that field. Cells without a finite scalar are left out; `leftOut` says how many.
/// \throws Error (BadInput) if the field has another number of values than the mesh has points or cells, or no cell has
/// a finite scalar.
std::shared_ptr<const mesh::ScalarMesh> scalarMesh(const Mesh::Data& data, const Field& field, std::uint64_t& leftOut);

/// A mesh as readers leave it, whose fields count its own points and tetrahedra.
std::shared_ptr<const Mesh> checkedMesh(mesh::SharedArray<glm::dvec3> positions,
                                        mesh::SharedArray<mesh::Tetrahedron> cells);

MeshReport publicReport(const mesh::MeshReport& report);

}  // namespace renderer
}  // namespace tetralux
