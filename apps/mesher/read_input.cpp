// SPDX-License-Identifier: Apache-2.0
#include "read_input.h"

#include <fmt/format.h>

#include <filesystem>
#include <stdexcept>

#include "file_name.h"
#include "polydata_vtk.h"
#include "read_points_text.h"
#ifdef TETRALUX_CGAL
#include "read_soup_cgal.h"
#endif

namespace tetralux::mesher {
namespace {

PolygonSoup readSurfaceFile(const std::string& path) {
#ifdef TETRALUX_CGAL
    return readSoupByCgal(path);
#else
    throw std::runtime_error(fmt::format(
        "{}: this tetralux-mesher was built without CGAL: convert the file to .vtp, or build with TETRALUX_CGAL=ON",
        path));
#endif
}

}  // namespace

Input readInput(const std::string& source, std::vector<std::string>& leftOut) {
    const std::string ending = lowerEnding(source);
    std::error_code ignored;
    if (std::filesystem::is_directory(source, ignored)) return mesh::readMesh(source, mesh::isolatedReading());
    if (ending == ".csv" || ending == ".xyz" || ending == ".txt") return readPointsText(source);
    if (ending == ".stl" || ending == ".off" || ending == ".obj" || ending == ".ply") return readSurfaceFile(source);
    if (ending == ".vtp" || (ending == ".vtk" && isLegacyPolyData(source))) return readPolyData(source, &leftOut);
    return mesh::readMesh(source, mesh::isolatedReading());
}

}  // namespace tetralux::mesher
