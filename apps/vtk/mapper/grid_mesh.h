// SPDX-License-Identifier: Apache-2.0
/// \file
/// A grid of VTK as a mesh and a field of Tetralux's, each made again only when it has changed.
#pragma once

#include <cstdint>
#include <memory>

#include <tetralux/tetralux.h>

class vtkDataArray;
class vtkMatrix4x4;
class vtkUnstructuredGridBase;

namespace tetralux::vtk {

/// Which scalars of the grid are drawn.
struct ChosenScalars {
    vtkDataArray* array = nullptr;
    bool onCells = false;
    int component = 0;  ///< of vectors; -1: magnitude
};

/// What is drawn of a grid, as it was when it was made.
class GridMesh {
public:
    /// Takes up the grid, its points moved by `worldFromGrid`. Arrays are looked through when the grid's time has
    /// changed: \return whether the mesh was made again. \throws Error when the grid has nothing to draw.
    bool updateMesh(vtkUnstructuredGridBase& grid, vtkMatrix4x4& worldFromGrid);
    /// After updateMesh: \return whether the field was made again.
    bool updateField(vtkUnstructuredGridBase& grid, const ChosenScalars& scalars);

    const std::shared_ptr<const Mesh>& mesh() const { return mesh_; }
    const Field& field() const { return *field_; }
    double scalarRange() const { return scalarRange_; }  ///< largest less smallest finite scalar

private:
    std::shared_ptr<const Mesh> mesh_;
    std::optional<Field> field_;
    double scalarRange_ = 0;

    unsigned long long gridTime_ = 0, fieldTime_ = 0;
    const void* grid_ = nullptr;
    std::array<double, 16> matrix_{};
    std::uint64_t meshSum_ = 0;  ///< of all that the mesh was made of
    ChosenScalars scalars_;
};

}  // namespace tetralux::vtk
