// SPDX-License-Identifier: Apache-2.0
// A program that links this file's object is under the GPL-3.0 (or later): CGAL's Point_set_3 is; its other readers are
// under the LGPL-3.0.
#include "read_soup_cgal.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/IO/OBJ.h>
#include <CGAL/IO/OFF.h>
#include <CGAL/IO/PLY.h>
#include <CGAL/IO/STL.h>
#include <CGAL/Point_set_3.h>
#include <CGAL/Point_set_3/IO/PLY.h>
#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <iostream>
#include <sstream>
#include <stdexcept>

#include "file_name.h"

namespace tetralux::mesher {
namespace {

using Point = CGAL::Exact_predicates_inexact_constructions_kernel::Point_3;
using Polygons = std::vector<std::vector<std::size_t>>;

/// CGAL's readers return false and say why on std::cerr: this listens.
class ErrorCapture {
public:
    ErrorCapture() : before_(std::cerr.rdbuf(said_.rdbuf())) {}
    ~ErrorCapture() { std::cerr.rdbuf(before_); }
    ErrorCapture(const ErrorCapture&) = delete;
    ErrorCapture& operator=(const ErrorCapture&) = delete;
    /// The first line, without CGAL's own "error:".
    std::string text() const {
        std::istringstream lines(said_.str());
        std::string line;
        std::getline(lines, line);
        return line.empty() ? "the file ends too early or holds something else" : line;
    }

private:
    std::ostringstream said_;
    std::streambuf* before_;
};

bool parse(std::istream& file, const std::string& ending, std::vector<Point>& points, Polygons& polygons) {
    const auto verbose = CGAL::parameters::verbose(true);
    if (ending == ".stl") return CGAL::IO::read_STL(file, points, polygons, verbose);
    if (ending == ".off") return CGAL::IO::read_OFF(file, points, polygons, verbose);
    if (ending == ".ply") return CGAL::IO::read_PLY(file, points, polygons, verbose);
    // CGAL calls an OBJ file without faces an error; to us it is a point cloud
    return CGAL::IO::read_OBJ(file, points, polygons, verbose) || (file.eof() && !points.empty() && polygons.empty());
}

template <class T>
bool addProperty(const CGAL::Point_set_3<Point>& points, const std::string& name, std::vector<mesh::Field>& fields) {
    const auto [values, found] = points.property_map<T>(name);
    if (!found) return false;
    mesh::Field field{name, mesh::Association::Point, 1, {}};
    field.values.reserve(points.size());
    for (const auto& index : points) field.values.push_back(static_cast<double>(values[index]));
    fields.push_back(std::move(field));
    return true;
}

/// The vertex properties other than position, normal and colour (colours tell of a picture, not of a field).
std::vector<mesh::Field> plyFields(std::istream& file, std::size_t pointCount) {
    CGAL::Point_set_3<Point> points;
    std::vector<mesh::Field> fields;
    if (!CGAL::IO::read_PLY(file, points) || points.size() != pointCount) return fields;
    for (const std::string& name : points.properties()) {
        if (name == "index" || name == "point" || name == "normal" || name == "red" || name == "green" ||
            name == "blue" || name == "alpha")
            continue;
        addProperty<float>(points, name, fields) || addProperty<double>(points, name, fields) ||
            addProperty<std::int32_t>(points, name, fields) || addProperty<std::uint32_t>(points, name, fields) ||
            addProperty<std::int16_t>(points, name, fields) || addProperty<std::uint16_t>(points, name, fields) ||
            addProperty<std::int8_t>(points, name, fields) || addProperty<std::uint8_t>(points, name, fields);
    }
    return fields;
}

}  // namespace

PolygonSoup readSoupByCgal(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    if (!file) throw std::runtime_error(fmt::format("{}: cannot be opened: check the name and the permissions", path));
    std::vector<Point> points;
    Polygons polygons;
    const std::string ending = lowerEnding(path);
    {
        const ErrorCapture capture;
        if (!parse(file, ending, points, polygons))
            throw std::runtime_error(
                fmt::format("{}: not a whole {} file ({}): write it anew", path, ending.substr(1), capture.text()));
    }
    PolygonSoup soup;
    soup.points.reserve(points.size());
    for (const Point& p : points) soup.points.emplace_back(p.x(), p.y(), p.z());
    soup.polygons.reserve(polygons.size());
    for (std::size_t i = 0; i < polygons.size(); ++i) {
        for (const std::size_t index : polygons[i])
            if (index >= points.size())
                throw std::runtime_error(
                    fmt::format("{}: face {} names point {}, but there are {}: write the file anew", path, i, index,
                                points.size()));
        if (polygons[i].size() >= 3) soup.polygons.emplace_back(polygons[i].begin(), polygons[i].end());
    }
    if (ending == ".ply") {
        std::ifstream again(path, std::ios::binary);
        soup.fields = plyFields(again, soup.points.size());
    }
    return soup;
}

}  // namespace tetralux::mesher
