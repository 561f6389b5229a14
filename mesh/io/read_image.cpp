// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include <fmt/format.h>
#include <vtkImageData.h>
#include <vtkMetaImageReader.h>
#include <vtkNew.h>
#include <glm/geometric.hpp>

#include <mesh/io/file_checks.h>
#include <mesh/io/isolated_read.h>
#include <mesh/io/mesh_format.h>
#include <mesh/io/parse_mesh.h>
#include <mesh/io/text_scanner.h>
#include <mesh/io/vtk_soup.h>
#include <mesh/soup/grid_soup.h>

namespace tetralux::mesh {
namespace {

bool acceptsImage(const std::string& source) {
    return hasExtension(source, {".nrrd", ".nhdr", ".mha", ".mhd"});
}

CellSoup readNrrd(const std::string& source) {
    const auto readData = [&](const std::string& name) {
        const std::filesystem::path file = std::filesystem::path(source).parent_path() / name;
        std::error_code failed;
        if (!std::filesystem::is_regular_file(file, failed)) {
            throw std::runtime_error(
                fmt::format("{}: names {}, which is not there; put it there, or name the file that is", source, name));
        }
        return readWholeFile(file.string());
    };
    return parseNrrd(readWholeFile(source), source, readData);
}

/// The directions of the axes that a MetaImage's head gives, a line of the matrix for each: VTK's reader leaves them
/// out. Unit vectors along x, y and z if there are none.
std::array<glm::dvec3, 3> metaDirections(const std::string& source) {
    std::array<glm::dvec3, 3> directions = GridFrame().steps;
    std::ifstream file(source, std::ios::binary);
    std::string line;
    for (int lines = 0; lines < 100 && line.find("ElementDataFile") != 0 && std::getline(file, line); ++lines) {
        const std::size_t equals = line.find('=');
        const std::string key = line.substr(0, line.find_first_of(" =\t"));
        if (equals == std::string::npos || (key != "TransformMatrix" && key != "Rotation" && key != "Orientation")) {
            continue;
        }
        std::array<glm::dvec3, 3> found;
        std::istringstream numbers(line.substr(equals + 1));
        for (glm::dvec3& direction : found) {
            numbers >> direction.x >> direction.y >> direction.z;
        }
        if (numbers && glm::dot(glm::cross(found[0], found[1]), found[2]) != 0.0) {
            directions = found;
        }
    }
    return directions;
}

CellSoup readMetaImage(const std::string& source) {
    vtkNew<vtkMetaImageReader> reader;
    reader->SetFileName(source.c_str());
    CellSoup soup = soupFromReader(*reader, std::nullopt);
    const std::array<glm::dvec3, 3> directions = metaDirections(source);
    vtkImageData* image = reader->GetOutput();
    const int* points = image->GetDimensions();
    GridFrame frame;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        frame.origin[static_cast<int>(axis)] = image->GetOrigin()[axis];
        frame.steps[axis] = image->GetSpacing()[axis] * directions[axis];
    }
    placeGrid(
        soup,
        {static_cast<std::size_t>(points[0]), static_cast<std::size_t>(points[1]), static_cast<std::size_t>(points[2])},
        frame);
    return soup;
}

CellSoup readImage(const std::string& source, const ReadOptions&) {
    checkReadable(source);
    if (hasExtension(source, {".nrrd", ".nhdr"})) {
        return readNrrd(source);
    }
    return readIsolated(source, [&] { return readMetaImage(source); });
}

}  // namespace

const MeshFormat imageFormat{"image volume", ".nrrd .nhdr .mha .mhd", acceptsImage, readImage};

}  // namespace tetralux::mesh
