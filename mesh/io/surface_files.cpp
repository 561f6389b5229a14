// SPDX-License-Identifier: Apache-2.0
//
// Surfaces as .vtp, binary .ply and binary .stl.
#include <algorithm>
#include <array>
#include <bit>
#include <cctype>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <limits>
#include <set>
#include <sstream>
#include <stdexcept>

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <mesh/io/appended_head.h>
#include <mesh/tet/field_surface.h>

namespace tetralux::mesh {

namespace {

std::string vtpFile(const FieldSurface& surface) {
    constexpr const char* polygons = "PolyData";
    const auto& points = surface.positions;
    const std::size_t count = surface.triangles.size();
    AppendedHead head(polygons);
    head.open(
        fmt::format("<Piece NumberOfPoints=\"{}\" NumberOfVerts=\"0\" NumberOfLines=\"0\" NumberOfStrips=\"0\" "
                    "NumberOfPolys=\"{}\">\n<Points>\n",
                    points.size(), count));
    head.declare("Float64", "Points", 3, points.size() * 3 * sizeof(double));
    head.open("</Points>\n<Polys>\n");
    head.declare("Int64", "connectivity", 1, 3 * count * sizeof(std::int64_t));
    head.declare("Int64", "offsets", 1, count * sizeof(std::int64_t));
    head.open("</Polys>\n");
    head.declareFields(surface.fields, Association::Point);
    head.declareFields(surface.fields, Association::Cell);
    std::ostringstream out;
    out << head.finished(polygons);
    putArray(out, points);
    putMade<std::int64_t>(out, 3 * count, [&](std::uint64_t i) { return surface.triangles[i / 3][i % 3]; });
    putMade<std::int64_t>(out, count, [](std::uint64_t i) { return 3 * (i + 1); });
    putFields(out, surface.fields, Association::Point);
    putFields(out, surface.fields, Association::Cell);
    out << appendedTail;
    return std::move(out).str();
}

/// The least significant byte first, whatever the machine's order.
template <class T>
void putLittle(std::string& out, T value) {
    std::array<char, sizeof(T)> bytes{};
    std::memcpy(bytes.data(), &value, sizeof(T));
    if (std::endian::native == std::endian::big) std::reverse(bytes.begin(), bytes.end());
    out.append(bytes.data(), bytes.size());
}

/// Names of properties: words, each there once.
class PropertyNames {
public:
    explicit PropertyNames(std::set<std::string> taken) : taken_(std::move(taken)) {}

    std::string of(const Field& field, int component) {
        std::string name;
        for (const char c : field.name) name += std::isalnum(static_cast<unsigned char>(c)) != 0 ? c : '_';
        if (name.empty()) name = "field";
        if (field.components > 1)
            name += field.components <= 3 ? fmt::format("_{}", "xyz"[component]) : fmt::format("_{}", component);
        while (!taken_.insert(name).second) name += '_';
        return name;
    }

private:
    std::set<std::string> taken_;
};

std::string propertyLines(const FieldSurface& surface, Association association, std::set<std::string> taken) {
    PropertyNames names(std::move(taken));
    std::string lines;
    for (const Field& field : surface.fields)
        for (int c = 0; field.association == association && c < field.components; ++c)
            lines += fmt::format("property double {}\n", names.of(field, c));
    return lines;
}

void putProperties(std::string& out, const FieldSurface& surface, Association association, std::size_t place) {
    for (const Field& field : surface.fields) {
        if (field.association != association) continue;
        const auto width = static_cast<std::size_t>(field.components);
        for (std::size_t c = 0; c < width; ++c) putLittle(out, field.values[place * width + c]);
    }
}

std::string plyFile(const FieldSurface& surface) {
    std::string out = fmt::format(
        "ply\nformat binary_little_endian 1.0\nelement vertex {}\nproperty double x\nproperty double y\n"
        "property double z\n{}element face {}\nproperty list uchar int vertex_indices\n{}end_header\n",
        surface.positions.size(), propertyLines(surface, Association::Point, {"x", "y", "z"}), surface.triangles.size(),
        propertyLines(surface, Association::Cell, {"vertex_indices"}));
    if (surface.positions.size() > static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max()))
        throw std::runtime_error("a .ply file counts no more than 2147483647 points; give .vtp");
    for (std::size_t i = 0; i < surface.positions.size(); ++i) {
        for (int axis = 0; axis < 3; ++axis) putLittle(out, surface.positions[i][axis]);
        putProperties(out, surface, Association::Point, i);
    }
    for (std::size_t i = 0; i < surface.triangles.size(); ++i) {
        out += '\3';
        for (const PointIndex corner : surface.triangles[i]) putLittle(out, static_cast<std::int32_t>(corner));
        putProperties(out, surface, Association::Cell, i);
    }
    return out;
}

/// Single precision must tell the surface's points apart: where it lies far from the origin it does not.
void checkFitsFloats(const FieldSurface& surface) {
    constexpr double infinite = std::numeric_limits<double>::infinity();
    glm::dvec3 low(infinite), high(-infinite);
    for (const glm::dvec3& p : surface.positions) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    const glm::dvec3 farthest = glm::max(glm::abs(low), glm::abs(high));
    const double largest = std::max({farthest.x, farthest.y, farthest.z});
    constexpr double share = 1e-4;  // of its size that rounding may move the surface by
    if (largest > std::numeric_limits<float>::max() ||
        largest * std::numeric_limits<float>::epsilon() > share * glm::length(high - low))
        throw std::runtime_error(
            fmt::format("coordinates up to {:.6g} of a surface {:.3g} large are too much for the single precision of "
                        ".stl; give .vtp or .ply",
                        largest, glm::length(high - low)));
}

std::string stlFile(const FieldSurface& surface) {
    checkFitsFloats(surface);
    // what has become an edge by rounding leaves no gap: its neighbours meet
    std::vector<std::array<glm::vec3, 3>> kept;
    for (const auto& [i, j, k] : surface.triangles) {
        const glm::vec3 a(surface.positions[i]), b(surface.positions[j]), c(surface.positions[k]);
        if (a != b && b != c && c != a) kept.push_back({a, b, c});
    }
    if (kept.size() > std::numeric_limits<std::uint32_t>::max())
        throw std::runtime_error("a .stl file counts no more than 4294967295 triangles; give .vtp");
    std::string out(80, ' ');  // not beginning with "solid", which would say that it is text
    putLittle(out, static_cast<std::uint32_t>(kept.size()));
    for (const auto& [a, b, c] : kept) {
        const glm::dvec3 across = glm::cross(glm::dvec3(b) - glm::dvec3(a), glm::dvec3(c) - glm::dvec3(a));
        const double length = glm::length(across);
        const glm::vec3 normal = length > 0.0 ? glm::vec3(across / length) : glm::vec3(0);
        for (const glm::vec3& v : {normal, a, b, c})
            for (int axis = 0; axis < 3; ++axis) putLittle(out, v[axis]);
        putLittle(out, std::uint16_t{0});
    }
    return out;
}

}  // namespace

SurfaceFormat surfaceFormat(const std::string& path) {
    std::string ending = std::filesystem::path(path).extension().string();
    for (char& letter : ending) letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
    if (ending == ".vtp") return SurfaceFormat::Vtp;
    if (ending == ".ply") return SurfaceFormat::Ply;
    if (ending == ".stl") return SurfaceFormat::Stl;
    throw std::runtime_error(
        fmt::format("{}: no surface can be written to a file of that kind; let it end in .vtp, .ply or .stl", path));
}

std::string surfaceFile(const FieldSurface& surface, SurfaceFormat format) {
    switch (format) {
        case SurfaceFormat::Vtp:
            return vtpFile(surface);
        case SurfaceFormat::Ply:
            return plyFile(surface);
        case SurfaceFormat::Stl:
            break;
    }
    return stlFile(surface);
}

}  // namespace tetralux::mesh
