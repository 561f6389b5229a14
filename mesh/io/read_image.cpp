// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <vector>

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

/// The first and the last of the files that `pattern`, a name with one %d or %03d in it, stands for.
std::vector<std::string> numberedFiles(const std::string& pattern, int first, int last) {
    const std::size_t percent = pattern.find('%');
    const std::size_t end = pattern.find('d', percent);
    if (end >= pattern.size()) {
        return {};
    }
    const std::string format = pattern.substr(percent + 1, end - percent - 1);
    const std::size_t width = format.empty() ? 0 : std::strtoul(format.c_str(), nullptr, 10) % 64;
    std::vector<std::string> names;
    for (const int number : {first, last}) {
        const std::string digits =
            format.starts_with('0') ? fmt::format("{:0{}}", number, width) : fmt::format("{:{}}", number, width);
        names.push_back(pattern.substr(0, percent) + digits + pattern.substr(end + 1));
    }
    return names;
}

/// The files that hold the values of a MetaImage, by its head: one, a list of slices, or a pattern for their numbers.
/// None if the values stand in the file itself.
std::vector<std::string> metaFiles(const std::string& source) {
    std::ifstream file(source, std::ios::binary);
    std::string line;
    for (int lines = 0; lines < 100 && std::getline(file, line); ++lines) {
        if (!line.starts_with("ElementDataFile")) {
            continue;
        }
        std::istringstream words(line.substr(std::min(line.find('=') + 1, line.size())));
        std::string name;
        words >> name;
        std::vector<std::string> names;
        if (name == "LIST") {
            for (std::string next; names.size() < 100'000 && std::getline(file, next);) {
                next.erase(next.find_last_not_of(" \t\r") + 1);
                if (!next.empty()) {
                    names.push_back(next);
                }
            }
        } else if (name.find('%') < name.size()) {
            int first = 0;
            int last = 0;
            if (words >> first >> last) {
                names = numberedFiles(name, first, last);
            }
        } else if (name != "LOCAL" && name != "Local" && name != "local" && !name.empty()) {
            std::string rest;
            std::getline(words, rest);  // names may have spaces
            rest.erase(rest.find_last_not_of(" \t\r") + 1);
            names.push_back(name + rest);
        }
        return names;
    }
    return {};
}

/// VTK takes half a minute to find out that a slice is not there, and does not say which.
void checkMetaFiles(const std::string& source) {
    for (const std::string& name : metaFiles(source)) {
        std::error_code failed;
        if (!std::filesystem::is_regular_file(std::filesystem::path(source).parent_path() / name, failed)) {
            throw std::runtime_error(
                fmt::format("{}: names {}, which is not there; put it there, or name the file that is", source, name));
        }
    }
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

CellSoup readImage(const std::string& source, const ReadOptions& options) {
    checkReadable(source);
    if (hasExtension(source, {".nrrd", ".nhdr"})) {
        return readNrrd(source);
    }
    checkMetaFiles(source);
    return readThirdParty(source, options.isolated, [&] { return readMetaImage(source); });
}

}  // namespace

const MeshFormat imageFormat{"image volume", ".nrrd .nhdr .mha .mhd", acceptsImage, readImage};

}  // namespace tetralux::mesh
