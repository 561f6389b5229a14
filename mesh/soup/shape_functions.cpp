// SPDX-License-Identifier: Apache-2.0
#include <mesh/soup/shape_functions.h>

#include <vtkGenericCell.h>
#include <vtkHigherOrderHexahedron.h>
#include <vtkHigherOrderTetra.h>
#include <vtkHigherOrderWedge.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPoints.h>

#include <mesh/soup/cell_types.h>

namespace tetralux::mesh {
namespace {

constexpr std::size_t highestOrder = 10;

std::size_t pointsOfOrder(Shape shape, std::size_t p) {
    switch (shape) {
        case Shape::Tet:
            return (p + 1) * (p + 2) * (p + 3) / 6;
        case Shape::Hexahedron:
            return (p + 1) * (p + 1) * (p + 1);
        case Shape::Wedge:
            return (p + 1) * (p + 1) * (p + 2) / 2;
        default:
            return 0;  // VTK has no class for a pyramid of arbitrary order
    }
}

void setOrder(vtkCell* cell, vtkIdType pointCount) {
    if (auto* hexahedron = vtkHigherOrderHexahedron::SafeDownCast(cell)) {
        hexahedron->SetUniformOrderFromNumPoints(pointCount);
    } else if (auto* wedge = vtkHigherOrderWedge::SafeDownCast(cell)) {
        wedge->SetUniformOrderFromNumPoints(pointCount);
    } else if (auto* tetra = vtkHigherOrderTetra::SafeDownCast(cell)) {
        tetra->Initialize();
    }
}

}  // namespace

std::optional<int> curvedCellOrder(std::uint8_t type, std::size_t pointCount) {
    const CellTypeInfo info = cellTypeInfo(type);
    if (info.linear || info.shape == Shape::None) {
        return std::nullopt;
    }
    if (info.pointCount != 0) {
        return pointCount == static_cast<std::size_t>(info.pointCount) ? std::optional<int>(2) : std::nullopt;
    }
    for (std::size_t p = 1; p <= highestOrder; ++p) {
        if (pointsOfOrder(info.shape, p) == pointCount) {
            return static_cast<int>(p);
        }
    }
    return std::nullopt;
}

std::vector<std::vector<double>> shapeFunctions(std::uint8_t type, std::size_t pointCount,
                                                const std::vector<std::array<double, 3>>& places) {
    vtkNew<vtkGenericCell> generic;
    generic->SetCellType(type);
    vtkCell* cell = generic->GetRepresentativeCell();
    const vtkIdType count = static_cast<vtkIdType>(pointCount);
    cell->PointIds->SetNumberOfIds(count);
    cell->Points->SetNumberOfPoints(count);
    setOrder(cell, count);
    std::vector<std::vector<double>> weights;
    for (const std::array<double, 3>& place : places) {
        std::vector<double>& row = weights.emplace_back(pointCount, 0.0);
        cell->InterpolateFunctions(place.data(), row.data());
    }
    return weights;
}

}  // namespace tetralux::mesh
