// SPDX-License-Identifier: Apache-2.0
#include <mesh/io/read_surface.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string_view>

#include <fmt/format.h>
#include <vtkCellArray.h>
#include <vtkNew.h>
#include <vtkOBJReader.h>
#include <vtkPLYReader.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataReader.h>
#include <vtkSTLReader.h>
#include <vtkSmartPointer.h>
#include <vtkTriangleFilter.h>
#include <vtkXMLPolyDataReader.h>

#include <mesh/io/file_checks.h>
#include <mesh/io/isolated_read.h>
#include <mesh/io/text_scanner.h>
#include <mesh/io/vtk_soup.h>
#include <mesh/soup/cell_types.h>
#include <mesh/tet/orientation.h>
#include <mesh/tet/select_scalar.h>

namespace tetralux::mesh {
namespace {

using PolygonReader = vtkSmartPointer<vtkPolyData> (*)(const std::string& path);

template <class Reader>
vtkSmartPointer<vtkPolyData> readWith(const std::string& path) {
    const vtkNew<Reader> reader;
    reader->SetFileName(path.c_str());
    if constexpr (requires { reader->ReadAllScalarsOn(); }) {  // of a legacy file VTK takes one array if not told
        reader->ReadAllScalarsOn();
        reader->ReadAllVectorsOn();
        reader->ReadAllFieldsOn();
    }
    reader->Update();
    return reader->GetOutput();
}

/// The Object File Format: "OFF", counts, points, polygons; colours at the end of a line are skipped.
vtkSmartPointer<vtkPolyData> readOff(const std::string& path) {
    const std::string text = readWholeFile(path);
    TextScanner scan(text, path, '#');
    const std::string_view kind = scan.word("OFF");
    if (kind != "OFF" && kind != "COFF" && kind != "NOFF" && kind != "CNOFF")
        scan.refuse(fmt::format("begins with '{}'", std::string(kind.substr(0, 20))), "give a text file of kind OFF");
    constexpr std::size_t shortestLine = 4;  // bytes
    const std::size_t pointCount = scan.count("the number of points", shortestLine);
    const std::size_t polygonCount = scan.count("the number of polygons", shortestLine);
    scan.restOfLine();  // the number of edges, which many leave out

    const vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    for (std::size_t i = 0; i < pointCount; ++i) {
        const double x = scan.number("a coordinate"), y = scan.number("a coordinate"), z = scan.number("a coordinate");
        points->InsertNextPoint(x, y, z);
        scan.restOfLine();
    }
    const vtkNew<vtkCellArray> polygons;
    for (std::size_t i = 0; i < polygonCount; ++i) {
        const std::size_t corners = scan.count("the number of corners", 2);
        polygons->InsertNextCell(static_cast<int>(corners));
        for (std::size_t k = 0; k < corners; ++k) {
            const std::int64_t point = scan.integer("the number of a point");
            if (point < 0 || point >= static_cast<std::int64_t>(pointCount))
                scan.fail(fmt::format("polygon {} names point {}, but there are {}", i, point, pointCount));
            polygons->InsertCellPoint(point);
        }
        scan.restOfLine();
    }
    auto surface = vtkSmartPointer<vtkPolyData>::New();
    surface->SetPoints(points);
    surface->SetPolys(polygons);
    return surface;
}

/// VTK takes a binary STL that ends too early for a whole one: 80 bytes, the number of triangles, 50 bytes for each.
void checkStlSize(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    std::array<char, 84> head{};
    file.read(head.data(), head.size());
    const std::string_view begin(head.data(), static_cast<std::size_t>(file.gcount()));
    const bool text = begin.starts_with("solid") && begin.find('\0') == std::string_view::npos;
    if (text || begin.size() < head.size()) return;  // VTK finds what is wrong with them
    std::uint32_t triangles = 0;
    std::memcpy(&triangles, head.data() + 80, sizeof triangles);
    if (const std::uintmax_t size = std::filesystem::file_size(path); size < 84 + std::uintmax_t{50} * triangles)
        throw std::runtime_error(
            fmt::format("{}: has {} bytes, too few for its {} triangles; write the file again", path, size, triangles));
}

PolygonReader readerFor(const std::string& path) {
    if (hasExtension(path, {".stl"})) return readWith<vtkSTLReader>;
    if (hasExtension(path, {".obj"})) return readWith<vtkOBJReader>;
    if (hasExtension(path, {".ply"})) return readWith<vtkPLYReader>;
    if (hasExtension(path, {".off"})) return readOff;
    if (hasExtension(path, {".vtp"})) return readWith<vtkXMLPolyDataReader>;
    if (hasExtension(path, {".vtk"})) return readWith<vtkPolyDataReader>;
    throw std::runtime_error(
        fmt::format("{}: unknown kind of surface; give one of .stl .obj .ply .off .vtp .vtk", path));
}

/// Polygons and strips as triangle cells; runs in the reader's own process.
CellSoup trianglesOf(vtkPolyData* surface) {
    CellSoup soup;
    if (surface == nullptr || surface->GetPoints() == nullptr) return soup;
    const vtkNew<vtkTriangleFilter> triangulate;
    triangulate->PassLinesOff();
    triangulate->PassVertsOff();
    triangulate->SetInputData(surface);
    triangulate->Update();
    throwOnVtkError();
    vtkPolyData* const result = triangulate->GetOutput();
    if (result->GetPoints() == nullptr) return soup;
    soup.fields = soupFromVtk(result).fields;
    soup.points.resize(static_cast<std::size_t>(result->GetNumberOfPoints()));
    for (std::size_t i = 0; i < soup.points.size(); ++i) result->GetPoint(static_cast<vtkIdType>(i), &soup.points[i].x);
    vtkIdType count = 0;
    const vtkIdType* corners = nullptr;
    vtkCellArray* const cells = result->GetPolys();
    for (cells->InitTraversal(); cells->GetNextCell(count, corners) != 0;) {
        if (count != 3) continue;
        std::array<std::uint32_t, 3> triangle{};
        for (std::size_t k = 0; k < 3; ++k)
            triangle[k] = corners[k] < 0 ? CellSoup::invalidPoint : static_cast<std::uint32_t>(corners[k]);
        appendCell(soup, cell_type::triangle, triangle);
    }
    return soup;
}

void takeScalars(std::vector<Field> fields, const std::string& name, const std::string& path, SurfaceMesh& surface) {
    TetMesh carrier;
    carrier.positions = surface.positions;
    carrier.fields = std::move(fields);
    ChosenScalar chosen;
    try {
        chosen = scalarOf(carrier, name);
    } catch (const std::runtime_error& error) {
        throw std::runtime_error(fmt::format("{}: {}", path, error.what()));
    }
    const bool onPoints = chosen.association == Association::Point;
    if (chosen.values.size() != (onPoints ? surface.positions.size() : surface.triangles.size()))
        throw std::runtime_error(
            fmt::format("{}: '{}' has not one value for each polygon; write the file again", path, name));
    const auto isThere = [&](std::size_t place) { return std::abs(chosen.values[place]) <= largestScalar; };
    std::vector<std::array<PointIndex, 3>> kept;
    for (std::size_t i = 0; i < surface.triangles.size(); ++i) {
        const std::array<PointIndex, 3>& corners = surface.triangles[i];
        if (onPoints ? !std::all_of(corners.begin(), corners.end(), isThere) : !isThere(i)) continue;
        kept.push_back(corners);
        if (!onPoints) surface.scalars.push_back(chosen.values[i]);
    }
    if (kept.empty())
        throw std::runtime_error(fmt::format("{}: no value of '{}' is finite; choose another field", path, name));
    surface.triangles = std::move(kept);
    surface.association = chosen.association;
    if (onPoints) surface.scalars = std::move(chosen.values);
}

}  // namespace

SurfaceMesh readSurface(const std::string& path, bool isolated, const std::string& field) {
    const PolygonReader read = readerFor(path);
    std::error_code failed;
    if (!std::filesystem::exists(path, failed))
        throw std::runtime_error(fmt::format("{}: no such surface file; check the path", path));
    if (std::filesystem::is_directory(path, failed))
        throw std::runtime_error(fmt::format("{}: is a directory; give a surface file", path));
    checkReadable(path);
    if (hasExtension(path, {".stl"})) checkStlSize(path);
    // our own parser needs no process of its own; VTK makes triangles of what it found
    const vtkSmartPointer<vtkPolyData> parsed = read == readOff ? readOff(path) : nullptr;
    const CellSoup soup = readThirdParty(path, isolated, [&] {
        captureVtkMessages();
        const vtkSmartPointer<vtkPolyData> polygons = parsed != nullptr ? parsed : read(path);
        throwOnVtkError();
        return trianglesOf(polygons);
    });
    SurfaceMesh surface;
    surface.positions = soup.points;
    for (std::size_t i = 0; i + 3 <= soup.connectivity.size(); i += 3) {
        const std::array<PointIndex, 3> triangle{soup.connectivity[i], soup.connectivity[i + 1],
                                                 soup.connectivity[i + 2]};
        for (const PointIndex point : triangle)
            if (point >= soup.points.size() || !isFinitePosition(soup.points[point]))
                throw std::runtime_error(fmt::format(
                    "{}: triangle {} has a corner that is not there or not finite; write the file again", path, i / 3));
        surface.triangles.push_back(triangle);
    }
    if (surface.triangles.empty())
        throw std::runtime_error(fmt::format("{}: holds no polygon; give a surface, or write the file again", path));
    if (!field.empty()) takeScalars(std::move(soup.fields), field, path, surface);
    return surface;
}

}  // namespace tetralux::mesh
