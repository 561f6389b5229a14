// SPDX-License-Identifier: Apache-2.0
#include <mesh/io/vtk_soup.h>

#include <algorithm>
#include <array>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCompositeDataIterator.h>
#include <vtkCompositeDataSet.h>
#include <vtkDataArray.h>
#include <vtkDataSetAttributes.h>
#include <vtkIdTypeArray.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkMatrix4x4.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkRectilinearGrid.h>
#include <vtkSmartPointer.h>
#include <vtkStructuredGrid.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>

#include <mesh/io/bookkeeping_names.h>
#include <mesh/soup/append_soup.h>
#include <mesh/soup/block_names.h>
#include <mesh/soup/cell_types.h>
#include <mesh/soup/grid_soup.h>

namespace tetralux::mesh {
namespace {

/// Calls `use(pointer, count)` with the values of `array` in their own type.
template <class Use>
void withValues(vtkDataArray* array, const Use& use) {
    const std::size_t count = static_cast<std::size_t>(array->GetNumberOfValues());
    switch (array->GetDataType()) {
        vtkTemplateMacro(use(static_cast<const VTK_TT*>(array->GetVoidPointer(0)), count));
        default: {  // bits
            std::vector<double> values(count);
            for (std::size_t i = 0; i < count; ++i) {
                const auto components = static_cast<std::size_t>(array->GetNumberOfComponents());
                values[i] =
                    array->GetComponent(static_cast<vtkIdType>(i / components), static_cast<int>(i % components));
            }
            use(values.data(), count);
        }
    }
}

void takePoints(vtkPoints* source, CellSoup& soup) {
    if (source == nullptr) {
        return;
    }
    withValues(source->GetData(), [&](const auto* values, std::size_t count) {
        soup.points.resize(count / 3);
        for (std::size_t i = 0; i < count / 3; ++i) {
            soup.points[i] = {static_cast<double>(values[3 * i]), static_cast<double>(values[3 * i + 1]),
                              static_cast<double>(values[3 * i + 2])};
        }
    });
}

template <class Id>
std::uint32_t pointNumber(Id id) {
    const auto wide = static_cast<long long>(id);
    return wide < 0 || wide >= static_cast<long long>(CellSoup::invalidPoint) ? CellSoup::invalidPoint
                                                                              : static_cast<std::uint32_t>(wide);
}

void takeConnectivity(vtkUnstructuredGrid* grid, CellSoup& soup) {
    const std::size_t cells = static_cast<std::size_t>(grid->GetNumberOfCells());
    if (cells == 0) {
        return;
    }
    const unsigned char* types = grid->GetCellTypesArray()->GetPointer(0);
    soup.types.assign(types, types + cells);
    const auto isOurOwn = [](std::uint8_t type) { return type >= cell_type::gmshPyramid; };
    std::replace_if(soup.types.begin(), soup.types.end(), isOurOwn, std::uint8_t{255});
    withValues(grid->GetCells()->GetOffsetsArray(), [&](const auto* values, std::size_t count) {
        soup.offsets.resize(count);
        for (std::size_t i = 0; i < count; ++i) {
            soup.offsets[i] = static_cast<std::uint64_t>(values[i]);
        }
    });
    withValues(grid->GetCells()->GetConnectivityArray(), [&](const auto* values, std::size_t count) {
        soup.connectivity.resize(count);
        for (std::size_t i = 0; i < count; ++i) {
            soup.connectivity[i] = pointNumber(values[i]);
        }
    });
}

/// VTK keeps, for each polyhedron, the number of its faces and then for each face its size and points.
void takePolyhedra(vtkUnstructuredGrid* grid, CellSoup& soup) {
    vtkIdTypeArray* locations = grid->GetFaceLocations();
    vtkIdTypeArray* faces = grid->GetFaces();
    if (locations == nullptr || faces == nullptr) {
        return;
    }
    const vtkIdType streamSize = faces->GetNumberOfValues();
    const vtkIdType* const stream = faces->GetPointer(0);
    soup.faceOffsets.push_back(0);
    for (std::size_t cell = 0; cell < soup.types.size(); ++cell) {
        const vtkIdType place = static_cast<vtkIdType>(cell);
        vtkIdType at = place < locations->GetNumberOfValues() ? locations->GetValue(place) : -1;
        if (soup.types[cell] == cell_type::polyhedron && at >= 0 && at < streamSize) {
            const vtkIdType faceCount = stream[at++];
            for (vtkIdType face = 0; face < faceCount && at < streamSize; ++face) {
                const vtkIdType points = stream[at];
                if (points < 0 || points >= streamSize - at) {
                    break;  // the cell stays incomplete, which validation finds
                }
                soup.faceStream.push_back(static_cast<std::uint32_t>(points));
                for (vtkIdType k = 1; k <= points; ++k) {
                    soup.faceStream.push_back(pointNumber(stream[at + k]));
                }
                at += points + 1;
            }
        }
        soup.faceOffsets.push_back(soup.faceStream.size());
    }
}

bool isBookkeeping(vtkDataSetAttributes* attributes, int index, const std::string& name) {
    const int role = attributes->IsArrayAnAttribute(index);
    return role == vtkDataSetAttributes::GLOBALIDS || role == vtkDataSetAttributes::PEDIGREEIDS ||
           isBookkeepingName(name);
}

void takeFields(vtkDataSetAttributes* attributes, Association association, std::size_t places, CellSoup& soup) {
    for (int i = 0; i < attributes->GetNumberOfArrays(); ++i) {
        vtkDataArray* array = attributes->GetArray(i);
        if (array == nullptr || static_cast<std::size_t>(array->GetNumberOfTuples()) != places) {
            continue;  // strings, or an array that is cut short
        }
        Field field;
        field.name =
            array->GetName() != nullptr && array->GetName()[0] != '\0' ? array->GetName() : fmt::format("array {}", i);
        if (field.name == "vtkGhostType" || field.name == "vtkGhostLevels" || field.name == "vtkValidPointMask") {
            continue;
        }
        field.association = association;
        field.components = array->GetNumberOfComponents();
        withValues(array, [&](const auto* values, std::size_t count) {
            field.values.resize(count);
            for (std::size_t k = 0; k < count; ++k) {
                field.values[k] = static_cast<double>(values[k]);
            }
        });
        for (int c = 0; array->HasAComponentName() && c < field.components; ++c) {
            const char* const name = array->GetComponentName(c);
            field.componentNames.emplace_back(name != nullptr ? name : std::to_string(c));
        }
        field.bookkeeping = isBookkeeping(attributes, i, field.name);
        soup.fields.push_back(std::move(field));
    }
}

void hideCells(vtkDataSet* data, CellSoup& soup) {
    const std::size_t cells = soup.types.size();
    const auto flagged = [](vtkDataArray* array, std::size_t i, int mask) {
        return (static_cast<int>(array->GetComponent(static_cast<vtkIdType>(i), 0)) & mask) != 0;
    };
    const auto usable = [](vtkDataArray* array, std::size_t count) {
        return array != nullptr && static_cast<std::size_t>(array->GetNumberOfTuples()) == count;
    };
    vtkDataArray* cellGhosts = data->GetCellData()->GetArray("vtkGhostType");
    vtkDataArray* cellLevels = data->GetCellData()->GetArray("vtkGhostLevels");
    vtkDataArray* pointGhosts = data->GetPointData()->GetArray("vtkGhostType");
    const bool pointFlags = usable(pointGhosts, soup.points.size());
    constexpr int notDrawn = vtkDataSetAttributes::DUPLICATECELL | vtkDataSetAttributes::REFINEDCELL |
                             vtkDataSetAttributes::EXTERIORCELL | vtkDataSetAttributes::HIDDENCELL;
    if (!usable(cellGhosts, cells) && !usable(cellLevels, cells) && !pointFlags) {
        return;
    }
    soup.hidden.assign(cells, 0);
    for (std::size_t i = 0; i < cells; ++i) {
        bool hidden = (usable(cellGhosts, cells) && flagged(cellGhosts, i, notDrawn)) ||
                      (usable(cellLevels, cells) && flagged(cellLevels, i, 0xff));
        for (std::uint64_t k = soup.offsets[i]; pointFlags && k < soup.offsets[i + 1] && k < soup.connectivity.size();
             ++k) {
            const std::uint32_t p = soup.connectivity[k];
            hidden = hidden || (p < soup.points.size() && flagged(pointGhosts, p, vtkDataSetAttributes::HIDDENPOINT));
        }
        soup.hidden[i] = hidden ? 1 : 0;
    }
}

/// Curved cells whose points alone do not say what they are: VTK keeps the rest in arrays of these names.
void refuseUnreadOrders(vtkUnstructuredGrid* grid) {
    if (vtkDataArray* degrees = grid->GetCellData()->GetArray("HigherOrderDegrees"); degrees != nullptr) {
        for (vtkIdType i = 0; i < degrees->GetNumberOfTuples(); ++i) {
            const double order = degrees->GetComponent(i, 0);
            for (int axis = 1; axis < degrees->GetNumberOfComponents(); ++axis) {
                if (degrees->GetComponent(i, axis) != order) {
                    throw std::runtime_error(
                        fmt::format("cell {} has a different order along each axis, which is not read; raise such "
                                    "cells to one order, or export them as linear ones",
                                    i));
                }
            }
        }
    }
    if (vtkDataArray* weights = grid->GetPointData()->GetArray("RationalWeights"); weights != nullptr) {
        for (vtkIdType i = 0; i < weights->GetNumberOfTuples(); ++i) {
            if (weights->GetComponent(i, 0) != 1.0) {
                throw std::runtime_error(
                    fmt::format("point {} has a rational weight other than 1, which is not read; export the Bézier "
                                "cells as Lagrange or linear ones",
                                i));
            }
        }
    }
}

void takeGridCells(const int dimensions[3], std::uint8_t type, CellSoup& soup) {
    std::array<std::size_t, 3> points{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        points[axis] = static_cast<std::size_t>(std::max(0, dimensions[axis]));
    }
    addGridCells(soup, points, type);
}

void takeGridPoints(vtkDataSet* grid, CellSoup& soup) {
    soup.points.resize(static_cast<std::size_t>(grid->GetNumberOfPoints()));
    for (std::size_t i = 0; i < soup.points.size(); ++i) {
        grid->GetPoint(static_cast<vtkIdType>(i), &soup.points[i].x);
    }
}

void takeSurface(vtkPolyData* surface, CellSoup& soup) {
    takePoints(surface->GetPoints(), soup);
    soup.types.assign(static_cast<std::size_t>(surface->GetNumberOfCells()), cell_type::triangle);
    soup.offsets.assign(soup.types.size() + 1, 0);
}

CellSoup soupFromDataSet(vtkDataSet* data) {
    CellSoup soup;
    int dimensions[3] = {0, 0, 0};
    if (auto* grid = vtkUnstructuredGrid::SafeDownCast(data)) {
        refuseUnreadOrders(grid);
        takePoints(grid->GetPoints(), soup);
        takeConnectivity(grid, soup);
        takePolyhedra(grid, soup);
    } else if (auto* image = vtkImageData::SafeDownCast(data)) {
        image->GetDimensions(dimensions);
        takeGridCells(dimensions, cell_type::voxel, soup);
        takeGridPoints(data, soup);
        if (image->GetIndexToPhysicalMatrix()->Determinant() < 0.0) {
            mirrorVoxels(soup);
        }
    } else if (auto* rectilinear = vtkRectilinearGrid::SafeDownCast(data)) {
        rectilinear->GetDimensions(dimensions);
        takeGridCells(dimensions, cell_type::voxel, soup);
        takeGridPoints(data, soup);
    } else if (auto* curvilinear = vtkStructuredGrid::SafeDownCast(data)) {
        curvilinear->GetDimensions(dimensions);
        takeGridCells(dimensions, cell_type::hexahedron, soup);
        takePoints(curvilinear->GetPoints(), soup);
    } else if (auto* surface = vtkPolyData::SafeDownCast(data)) {
        takeSurface(surface, soup);
    } else {
        throw std::runtime_error(fmt::format("holds a {}, which has no cells; give a mesh", data->GetClassName()));
    }
    takeFields(data->GetPointData(), Association::Point, soup.points.size(), soup);
    takeFields(data->GetCellData(), Association::Cell, soup.types.size(), soup);
    hideCells(data, soup);
    return soup;
}

std::string blockName(vtkCompositeDataIterator* leaf) {
    if (leaf->HasCurrentMetaData() == 0 || leaf->GetCurrentMetaData()->Has(vtkCompositeDataSet::NAME()) == 0) return "";
    const char* const name = leaf->GetCurrentMetaData()->Get(vtkCompositeDataSet::NAME());
    return name != nullptr ? name : "";
}

/// All leaves with cells, one behind the other; where they have names, each is a block with its own.
CellSoup soupFromBlocks(vtkCompositeDataSet* composite) {
    std::vector<std::pair<vtkDataSet*, std::string>> parts;
    const auto leaf = vtkSmartPointer<vtkCompositeDataIterator>::Take(composite->NewIterator());
    for (leaf->InitTraversal(); !leaf->IsDoneWithTraversal(); leaf->GoToNextItem()) {
        auto* const part = vtkDataSet::SafeDownCast(leaf->GetCurrentDataObject());
        if (part != nullptr && part->GetNumberOfCells() > 0) parts.emplace_back(part, blockName(leaf));
    }
    const bool named =  // pieces of one mesh are not
        parts.size() > 1 &&
        std::any_of(parts.begin(), parts.end(), [](const auto& part) { return !part.second.empty(); });
    CellSoup soup;
    double number = 0.0;
    for (const auto& [part, name] : parts) {
        CellSoup block = soupFromDataSet(part);
        if (named) nameBlock(block, ++number, name);
        appendSoup(soup, std::move(block));
    }
    return soup;
}

}  // namespace

CellSoup soupFromVtk(vtkDataObject* data) {
    if (data == nullptr) {
        throw std::runtime_error("holds no data; write the file again");
    }
    if (auto* composite = vtkCompositeDataSet::SafeDownCast(data)) {
        return soupFromBlocks(composite);
    }
    if (auto* single = vtkDataSet::SafeDownCast(data)) {
        return soupFromDataSet(single);
    }
    throw std::runtime_error(fmt::format("holds a {}, which has no cells; give a mesh", data->GetClassName()));
}

}  // namespace tetralux::mesh
