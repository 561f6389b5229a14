// SPDX-License-Identifier: Apache-2.0
#include "polydata_vtk.h"

#include <fmt/format.h>
#include <vtkCallbackCommand.h>
#include <vtkCellArray.h>
#include <vtkCellArrayIterator.h>
#include <vtkCellData.h>
#include <vtkCommand.h>
#include <vtkDataArray.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataReader.h>
#include <vtkPolygon.h>
#include <vtkTriangleStrip.h>
#include <vtkXMLPolyDataReader.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "file_name.h"

namespace tetralux::mesher {
namespace {

void noteError(vtkObject*, unsigned long, void* seen, void*) {
    *static_cast<bool*>(seen) = true;
}

template <class Reader>
vtkPolyData* readWith(Reader* reader, const std::string& path) {
    bool failed = false;
    vtkNew<vtkCallbackCommand> listener;
    listener->SetCallback(noteError);
    listener->SetClientData(&failed);
    reader->AddObserver(vtkCommand::ErrorEvent, listener);
    reader->SetFileName(path.c_str());
    reader->Update();
    if (failed || reader->GetOutput() == nullptr)
        throw std::runtime_error(fmt::format("{}: not a whole VTK file of polygons: write it anew", path));
    return reader->GetOutput();
}

void addPolygon(vtkIdType count, const vtkIdType* ids, std::size_t points, const std::string& path, PolygonSoup& soup) {
    std::vector<std::uint32_t> polygon;
    for (vtkIdType k = 0; k < count; ++k) {
        if (ids[k] < 0 || static_cast<std::size_t>(ids[k]) >= points)
            throw std::runtime_error(fmt::format("{}: polygon {} names point {}, but there are {}: write the file anew",
                                                 path, soup.polygons.size(), ids[k], points));
        polygon.push_back(static_cast<std::uint32_t>(ids[k]));
    }
    if (polygon.size() >= 3) soup.polygons.push_back(std::move(polygon));
}

PolygonSoup soupOf(vtkPolyData* data, const std::string& path) {
    PolygonSoup soup;
    const vtkIdType count = data->GetNumberOfPoints();
    const auto points = static_cast<std::size_t>(count);
    soup.points.resize(points);
    for (vtkIdType i = 0; i < count; ++i) data->GetPoint(i, &soup.points[static_cast<std::size_t>(i)].x);
    vtkIdType n = 0;
    const vtkIdType* ids = nullptr;
    for (auto cell = vtk::TakeSmartPointer(data->GetPolys()->NewIterator()); !cell->IsDoneWithTraversal();
         cell->GoToNextCell()) {
        cell->GetCurrentCell(n, ids);
        addPolygon(n, ids, points, path, soup);
    }
    for (auto cell = vtk::TakeSmartPointer(data->GetStrips()->NewIterator()); !cell->IsDoneWithTraversal();
         cell->GoToNextCell()) {
        cell->GetCurrentCell(n, ids);
        for (vtkIdType k = 0; k + 2 < n; ++k) {  // every other triangle of a strip is turned over
            const vtkIdType triangle[3] = {ids[k], ids[k + 1 + k % 2], ids[k + 2 - k % 2]};
            addPolygon(3, triangle, points, path, soup);
        }
    }
    for (int a = 0; a < data->GetPointData()->GetNumberOfArrays(); ++a) {
        vtkDataArray* array = data->GetPointData()->GetArray(a);
        if (array == nullptr || array->GetNumberOfTuples() != count || array == data->GetPointData()->GetNormals() ||
            array == data->GetPointData()->GetTCoords())
            continue;
        const std::string name = array->GetName() != nullptr ? array->GetName() : fmt::format("field{}", a);
        mesh::Field field{name, mesh::Association::Point, array->GetNumberOfComponents(), {}};
        field.values.resize(points * static_cast<std::size_t>(field.components));
        for (vtkIdType i = 0; i < count; ++i) array->GetTuple(i, field.values.data() + i * field.components);
        soup.fields.push_back(std::move(field));
    }
    return soup;
}

void nameCellFields(vtkPolyData* data, std::vector<std::string>* names) {
    for (int a = 0; names != nullptr && a < data->GetCellData()->GetNumberOfArrays(); ++a) {
        const char* name = data->GetCellData()->GetArrayName(a);
        names->emplace_back(name != nullptr ? name : fmt::format("field{}", a));
    }
}

}  // namespace

bool isLegacyPolyData(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    std::string line;
    for (int i = 0; i < 6 && std::getline(file, line) && line.size() < 1000; ++i) {
        std::transform(line.begin(), line.end(), line.begin(),
                       [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
        if (line.find("DATASET") != std::string::npos) return line.find("POLYDATA") != std::string::npos;
    }
    return false;
}

PolygonSoup readPolyData(const std::string& path, std::vector<std::string>* leftOut) {
    if (!std::filesystem::is_regular_file(path))
        throw std::runtime_error(fmt::format("{}: cannot be opened: check the name and the permissions", path));
    if (lowerEnding(path) == ".vtk") {
        const vtkNew<vtkPolyDataReader> reader;
        reader->ReadAllScalarsOn();
        reader->ReadAllVectorsOn();
        reader->ReadAllFieldsOn();
        vtkPolyData* const data = readWith(reader.Get(), path);
        nameCellFields(data, leftOut);
        return soupOf(data, path);
    }
    const vtkNew<vtkXMLPolyDataReader> reader;
    vtkPolyData* const data = readWith(reader.Get(), path);
    nameCellFields(data, leftOut);
    return soupOf(data, path);
}

TriangleSurface triangulatePolygons(const PolygonSoup& soup) {
    TriangleSurface surface{soup.points, {}, soup.fields};
    const vtkNew<vtkPolygon> polygon;
    const vtkNew<vtkIdList> corners;
    for (const auto& p : soup.polygons) {
        if (p.size() == 3) {
            surface.triangles.push_back({p[0], p[1], p[2]});
            continue;
        }
        polygon->Initialize(0, nullptr, nullptr);
        polygon->Points->SetDataTypeToDouble();
        polygon->Points->SetNumberOfPoints(static_cast<vtkIdType>(p.size()));
        polygon->PointIds->SetNumberOfIds(static_cast<vtkIdType>(p.size()));
        for (std::size_t k = 0; k < p.size(); ++k) {
            polygon->Points->SetPoint(static_cast<vtkIdType>(k), &soup.points[p[k]].x);
            polygon->PointIds->SetId(static_cast<vtkIdType>(k), static_cast<vtkIdType>(k));
        }
        corners->Reset();
        if (polygon->Triangulate(corners) != 0 &&
            corners->GetNumberOfIds() == 3 * static_cast<vtkIdType>(p.size() - 2)) {
            const auto corner = [&](vtkIdType i) { return p[static_cast<std::size_t>(corners->GetId(i))]; };
            for (vtkIdType i = 0; i < corners->GetNumberOfIds(); i += 3)
                surface.triangles.push_back({corner(i), corner(i + 1), corner(i + 2)});
        } else {  // a fan; the check will say what is wrong with it
            for (std::size_t k = 1; k + 1 < p.size(); ++k) surface.triangles.push_back({p[0], p[k], p[k + 1]});
        }
    }
    return surface;
}

}  // namespace tetralux::mesher
