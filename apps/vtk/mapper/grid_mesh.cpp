// SPDX-License-Identifier: Apache-2.0
#include "grid_mesh.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <span>
#include <vector>

#include "vtkCellArray.h"
#include "vtkCellType.h"
#include "vtkDataArray.h"
#include "vtkDataSetAttributes.h"
#include "vtkIdList.h"
#include "vtkMatrix4x4.h"
#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"

namespace tetralux::vtk {

namespace {

/// What Mesh::fromCells takes.
struct CellArrays {
    std::vector<double> xyz;
    std::vector<std::uint8_t> types;
    std::vector<std::int64_t> offsets, connectivity, faceOffsets, faceStream;
};

std::vector<std::int64_t> numbersOf(vtkDataArray& array) {
    const auto count = static_cast<std::size_t>(array.GetNumberOfValues());
    std::vector<std::int64_t> numbers(count);
    if (array.GetDataTypeSize() == 8)
        std::memcpy(numbers.data(), array.GetVoidPointer(0), 8 * count);
    else
        std::copy_n(static_cast<const std::int32_t*>(array.GetVoidPointer(0)), count, numbers.begin());
    return numbers;
}

std::vector<double> pointsOf(vtkPoints& points, const std::array<double, 16>& m) {
    std::vector<double> xyz(3 * static_cast<std::size_t>(points.GetNumberOfPoints()));
    constexpr std::array<double, 16> identity{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    for (std::size_t i = 0; i < xyz.size(); i += 3) {
        double p[3];
        points.GetPoint(static_cast<vtkIdType>(i / 3), p);
        for (std::size_t row = 0; row < 3; ++row) {
            const double* r = &m[4 * row];
            xyz[i + row] = m == identity ? p[row] : r[0] * p[0] + r[1] * p[1] + r[2] * p[2] + r[3];
        }
    }
    return xyz;
}

/// Faces of polyhedra: for each cell where they begin in a stream of numbers of points and points.
void takeFaces(vtkUnstructuredGrid& grid, CellArrays& arrays) {
    if (std::find(arrays.types.begin(), arrays.types.end(), VTK_POLYHEDRON) == arrays.types.end()) return;
    vtkNew<vtkIdList> stream;
    arrays.faceOffsets.push_back(0);
    for (std::size_t cell = 0; cell < arrays.types.size(); ++cell) {
        if (arrays.types[cell] == VTK_POLYHEDRON) {
            grid.GetFaceStream(static_cast<vtkIdType>(cell), stream);
            for (vtkIdType i = 1; i < stream->GetNumberOfIds(); ++i) arrays.faceStream.push_back(stream->GetId(i));
        }
        arrays.faceOffsets.push_back(static_cast<std::int64_t>(arrays.faceStream.size()));
    }
}

CellArrays arraysOf(vtkUnstructuredGrid& grid, const std::array<double, 16>& matrix) {
    CellArrays arrays;
    if (grid.GetNumberOfCells() == 0 || grid.GetPoints() == nullptr)
        throw Error(Errc::BadInput, "the grid has no cells; give one with at least one solid cell");
    arrays.xyz = pointsOf(*grid.GetPoints(), matrix);
    const auto cells = static_cast<std::size_t>(grid.GetNumberOfCells());
    const unsigned char* types = grid.GetCellTypesArray()->GetPointer(0);
    arrays.types.assign(types, types + cells);
    arrays.offsets = numbersOf(*grid.GetCells()->GetOffsetsArray());
    arrays.connectivity = numbersOf(*grid.GetCells()->GetConnectivityArray());
    if (vtkUnsignedCharArray* ghosts = grid.GetCellGhostArray()) {
        constexpr int leftOut = vtkDataSetAttributes::DUPLICATECELL | vtkDataSetAttributes::HIDDENCELL;
        for (std::size_t cell = 0; cell < cells; ++cell)
            if ((ghosts->GetValue(static_cast<vtkIdType>(cell)) & leftOut) != 0) arrays.types[cell] = VTK_EMPTY_CELL;
    }
    takeFaces(grid, arrays);
    return arrays;
}

/// A sum that tells arrays apart. Times of change do not: who fills an array in place marks the grid or the array, and
/// filters hand on the same arrays in new grids.
class Checksum {
public:
    template <class T>
    void add(const std::vector<T>& values) {
        const auto* bytes = reinterpret_cast<const unsigned char*>(values.data());
        const std::size_t size = values.size() * sizeof(T);
        mix(size);
        std::size_t i = 0;
        for (; i + 32 <= size; i += 32)
            for (std::size_t lane = 0; lane < 4; ++lane) {
                std::uint64_t word = 0;
                std::memcpy(&word, bytes + i + 8 * lane, 8);
                lanes_[lane] = std::rotl(lanes_[lane] ^ (word * 0x9e3779b97f4a7c15u), 29) * 0xbf58476d1ce4e5b9u;
            }
        for (; i < size; ++i) mix(bytes[i]);
    }
    std::uint64_t value() {
        for (const std::uint64_t lane : lanes_) mix(lane);
        return sum_;
    }

private:
    void mix(std::uint64_t word) { sum_ = std::rotl(sum_ ^ (word * 0x94d049bb133111ebu), 31) * 0x9e3779b97f4a7c15u; }
    std::uint64_t lanes_[4] = {1, 2, 3, 4}, sum_ = 5;
};

std::uint64_t sumOf(const CellArrays& arrays) {
    Checksum sum;
    sum.add(arrays.xyz);
    sum.add(arrays.types);
    sum.add(arrays.offsets);
    sum.add(arrays.connectivity);
    sum.add(arrays.faceOffsets);
    sum.add(arrays.faceStream);
    return sum.value();
}

bool allTetrahedra(const CellArrays& arrays) {
    return arrays.connectivity.size() == 4 * arrays.types.size() &&
           std::all_of(arrays.types.begin(), arrays.types.end(), [](std::uint8_t type) { return type == VTK_TETRA; });
}

std::shared_ptr<const Mesh> meshOf(const CellArrays& arrays) {
    if (!allTetrahedra(arrays))
        return Mesh::fromCells(arrays.xyz, arrays.types, std::span<const std::int64_t>(arrays.offsets),
                               std::span<const std::int64_t>(arrays.connectivity), nullptr, arrays.faceOffsets,
                               arrays.faceStream);
    std::vector<std::uint32_t> corners(arrays.connectivity.size());
    std::transform(arrays.connectivity.begin(), arrays.connectivity.end(), corners.begin(), [](std::int64_t point) {
        constexpr std::uint32_t outside = std::numeric_limits<std::uint32_t>::max();
        return point >= 0 && point < outside ? static_cast<std::uint32_t>(point) : outside;
    });
    return Mesh::fromTetrahedra(arrays.xyz, corners);
}

std::vector<double> valuesOf(vtkDataArray& array, int component) {
    std::vector<double> values(static_cast<std::size_t>(array.GetNumberOfTuples()));
    const int components = array.GetNumberOfComponents();
    const int one = std::clamp(component, 0, components - 1);
    for (std::size_t i = 0; i < values.size(); ++i) {
        const auto tuple = static_cast<vtkIdType>(i);
        if (component >= 0 || components == 1) {
            values[i] = array.GetComponent(tuple, one);
            continue;
        }
        double length = 0;
        for (int c = 0; c < components; ++c) length = std::hypot(length, array.GetComponent(tuple, c));
        values[i] = length;
    }
    return values;
}

double rangeOf(const std::vector<double>& values) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const double value : values) {
        if (!std::isfinite(value)) continue;
        low = std::min(low, value);
        high = std::max(high, value);
    }
    return high > low ? high - low : 0.0;
}

}  // namespace

bool GridMesh::updateMesh(vtkUnstructuredGridBase& grid, vtkMatrix4x4& worldFromGrid) {
    std::array<double, 16> matrix{};
    std::copy_n(&worldFromGrid.Element[0][0], 16, matrix.begin());
    if (mesh_ && grid_ == &grid && gridTime_ == grid.GetMTime() && matrix_ == matrix) return false;
    vtkNew<vtkUnstructuredGrid> copy;
    vtkUnstructuredGrid* plain = vtkUnstructuredGrid::SafeDownCast(&grid);
    if (plain == nullptr) {
        copy->DeepCopy(&grid);
        plain = copy;
    }
    const CellArrays arrays = arraysOf(*plain, matrix);
    const std::uint64_t sum = sumOf(arrays);
    const bool same = mesh_ && sum == meshSum_;
    if (!same) {
        mesh_.reset();
        mesh_ = meshOf(arrays);
    }
    meshSum_ = sum;
    grid_ = &grid;
    gridTime_ = grid.GetMTime();
    matrix_ = matrix;
    return !same;
}

bool GridMesh::updateField(vtkUnstructuredGridBase& grid, const ChosenScalars& scalars) {
    if (field_ && fieldTime_ == grid.GetMTime() && scalars.array == scalars_.array &&
        scalars.onCells == scalars_.onCells && scalars.component == scalars_.component)
        return false;
    const std::vector<double> values = valuesOf(*scalars.array, scalars.component);
    scalarRange_ = rangeOf(values);
    field_ = scalars.onCells ? Field::onCells(values) : Field::onPoints(values);
    fieldTime_ = grid.GetMTime();
    scalars_ = scalars;
    return true;
}

}  // namespace tetralux::vtk
