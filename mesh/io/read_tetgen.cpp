// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <span>
#include <stdexcept>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <mesh/io/file_checks.h>
#include <mesh/io/mesh_format.h>
#include <mesh/io/parse_mesh.h>
#include <mesh/io/text_scanner.h>
#include <mesh/soup/cell_types.h>

namespace tetralux::mesh {
namespace {

/// Empty fields for the values that stand behind a point or cell.
void addFields(CellSoup& soup, const char* name, Association association, std::size_t count, std::size_t places) {
    for (std::size_t i = 0; i < count; ++i) {
        Field field;
        field.name = count == 1 ? name : fmt::format("{} {}", name, i + 1);
        field.association = association;
        field.values.reserve(places);
        soup.fields.push_back(std::move(field));
    }
}

/// Chaste puts bytes behind the same heads.
void refuseBinary(TextScanner& scan, std::string_view head) {
    if (head.find("BIN") != std::string_view::npos) {
        scan.refuse("has its numbers as bytes, as Chaste writes them, which is not read", "save it as text");
    }
}

/// \returns the number of the first point, 0 or 1, which cells count from.
std::int64_t parseNodes(TextScanner& scan, CellSoup& soup) {
    const std::size_t points = scan.count("the number of points", 7);
    if (scan.integer("the dimension") != 3) {
        scan.refuse("has points of a dimension other than 3", "give a mesh of tetrahedra");
    }
    const std::size_t attributes = scan.count("the number of attributes", 1);
    // The rest says whether there are boundary markers: writers forget to say, or to write them.
    refuseBinary(scan, scan.restOfLine());
    addFields(soup, "attribute", Association::Point, attributes, points);
    std::int64_t first = 0;
    soup.points.reserve(points);
    for (std::size_t i = 0; i < points; ++i) {
        const std::int64_t number = scan.integer("the number of a point");
        first = i == 0 ? number : first;
        glm::dvec3 x;
        for (int axis = 0; axis < 3; ++axis) {
            x[axis] = scan.number("a coordinate");
        }
        soup.points.push_back(x);
        for (Field& field : soup.fields) {
            field.values.push_back(scan.number("an attribute"));
        }
        scan.restOfLine();
    }
    return first;
}

/// A tetrahedron of ten points with the middles of its edges as VTK has them: each is the one nearest to where the
/// middle is, for versions of TetGen and programs that write as it does have them in several orders.
std::array<std::uint32_t, 10> inVtkOrder(const std::array<std::uint32_t, 10>& ids, const CellSoup& soup) {
    constexpr std::array<std::array<std::size_t, 2>, 6> edges{{{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}}};
    std::array<std::uint32_t, 10> ordered = ids;
    if (std::find(ids.begin(), ids.end(), CellSoup::invalidPoint) != ids.end()) {
        return ordered;
    }
    std::array<bool, 10> taken{};
    for (std::size_t e = 0; e < edges.size(); ++e) {
        const glm::dvec3 middle = 0.5 * (soup.points[ids[edges[e][0]]] + soup.points[ids[edges[e][1]]]);
        std::size_t best = 0;
        for (std::size_t k = 4; k < ids.size(); ++k) {
            const auto away = [&](std::size_t n) { return glm::length(soup.points[ids[n]] - middle); };
            best = !taken[k] && (best == 0 || away(k) < away(best)) ? k : best;
        }
        taken[best] = true;
        ordered[4 + e] = ids[best];
    }
    return ordered;
}

void parseElements(TextScanner& scan, std::int64_t firstPoint, CellSoup& soup) {
    const std::size_t cells = scan.count("the number of tetrahedra", 9);
    const std::int64_t corners = scan.integer("the number of points of a tetrahedron");
    if (corners != 4 && corners != 10) {
        scan.refuse(fmt::format("has cells of {} points where TetGen writes 4 or 10", corners),
                    "give a mesh of tetrahedra");
    }
    const std::size_t attributes = scan.count("the number of region attributes", 1);
    refuseBinary(scan, scan.restOfLine());
    const std::size_t pointFields = soup.fields.size();
    addFields(soup, "region", Association::Cell, attributes, cells);
    for (std::size_t i = 0; i < cells; ++i) {
        scan.integer("the number of a tetrahedron");
        std::array<std::uint32_t, 10> ids{};
        for (std::size_t k = 0; k < static_cast<std::size_t>(corners); ++k) {
            const std::int64_t id = scan.integer("a point of a tetrahedron") - firstPoint;
            const bool known = id >= 0 && static_cast<std::uint64_t>(id) < soup.points.size();
            ids[k] = known ? static_cast<std::uint32_t>(id) : CellSoup::invalidPoint;
        }
        if (corners == 4) {
            appendCell(soup, cell_type::tetrahedron, std::span(ids).first(4));
        } else {
            appendCell(soup, cell_type::quadraticTetrahedron, inVtkOrder(ids, soup));
        }
        for (std::size_t a = 0; a < attributes; ++a) {
            soup.fields[pointFields + a].values.push_back(scan.number("a region attribute"));
        }
    }
}

bool acceptsTetgen(const std::string& source) {
    return hasExtension(source, {".node", ".ele"});
}

CellSoup readTetgen(const std::string& source, const ReadOptions&) {
    const std::string stem = source.substr(0, source.rfind('.'));
    const std::string nodes = stem + ".node";
    const std::string elements = stem + ".ele";
    return parseTetgen(readWholeFile(nodes), nodes, readWholeFile(elements), elements);
}

}  // namespace

CellSoup parseTetgen(std::string_view nodes, const std::string& nodeSource, std::string_view elements,
                     const std::string& elementSource) {
    CellSoup soup;
    TextScanner nodeScan(nodes, nodeSource, '#');
    const std::int64_t first = parseNodes(nodeScan, soup);
    TextScanner elementScan(elements, elementSource, '#');
    parseElements(elementScan, first, soup);
    return soup;
}

const MeshFormat tetgenFormat{"TetGen", ".node with .ele", acceptsTetgen, readTetgen};

}  // namespace tetralux::mesh
