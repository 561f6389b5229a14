// SPDX-License-Identifier: Apache-2.0
#include "tet_assembly.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <map>
#include <utility>

namespace tetralux::mesher {
namespace {

constexpr std::uint32_t unused = 0xffffffffu;

double sixVolumesOf(const std::vector<glm::dvec3>& points, const std::array<std::uint32_t, 4>& cell) {
    return mesh::sixVolumes(points[cell[0]], points[cell[1]], points[cell[2]], points[cell[3]]);
}

}  // namespace

Assembly assemble(const RawTetrahedra& raw, const std::vector<bool>& keep) {
    Assembly result;
    std::vector<std::uint32_t> newIndex(raw.points.size(), unused);
    double lost = 0.0;  // Kahan's sum
    for (std::size_t c = 0; c < raw.cells.size(); ++c) {
        if (!keep.empty() && !keep[c]) continue;
        auto cell = raw.cells[c];
        double six = sixVolumesOf(raw.points, cell);
        if (six < 0.0) {
            std::swap(cell[2], cell[3]);
            six = sixVolumesOf(raw.points, cell);
        }
        if (!(six > 0.0)) {
            ++result.flatCells;
            continue;
        }
        for (std::uint32_t& i : cell) {
            if (newIndex[i] == unused) {
                newIndex[i] = static_cast<std::uint32_t>(result.source.size());
                result.source.push_back(i);
                result.mesh.positions.push_back(raw.points[i]);
            }
            i = newIndex[i];
        }
        result.mesh.cells.push_back(cell);
        const double term = six - lost, next = result.volume + term;
        lost = (next - result.volume) - term;
        result.volume = next;
    }
    result.volume /= 6.0;
    return result;
}

std::vector<bool> insideOf(const TriangleSurface& surface, const RawTetrahedra& raw) {
    if (raw.regions.size() != raw.cells.size()) return {};
    std::map<std::int32_t, std::pair<double, std::size_t>> largest;  // region → volume and number of its largest cell
    for (std::size_t c = 0; c < raw.cells.size(); ++c) {
        const double size = std::abs(sixVolumesOf(raw.points, raw.cells[c]));
        auto& best = largest.try_emplace(raw.regions[c], -1.0, 0).first->second;
        if (size > best.first) best = {size, c};
    }
    std::map<std::int32_t, bool> inside;
    for (const auto& [region, best] : largest) {
        glm::dvec3 centre(0.0);
        for (const std::uint32_t i : raw.cells[best.second]) centre += 0.25 * raw.points[i];
        inside[region] = windingNumber(surface, centre) > 0.5;
    }
    std::vector<bool> keep(raw.cells.size());
    for (std::size_t c = 0; c < keep.size(); ++c) keep[c] = inside[raw.regions[c]];
    return keep;
}

double worstRadiusEdgeRatio(const mesh::TetMesh& mesh) {
    double worst = 0.0;
    for (const auto& cell : mesh.cells) {
        const glm::dvec3 a = mesh.positions[cell[0]];
        const glm::dvec3 b = mesh.positions[cell[1]] - a, c = mesh.positions[cell[2]] - a,
                         d = mesh.positions[cell[3]] - a;
        const double six = glm::dot(glm::cross(b, c), d);
        const glm::dvec3 centre = (glm::dot(b, b) * glm::cross(c, d) + glm::dot(c, c) * glm::cross(d, b) +
                                   glm::dot(d, d) * glm::cross(b, c)) /
                                  (2.0 * six);
        const double shortest = std::min({glm::length(b), glm::length(c), glm::length(d), glm::length(b - c),
                                          glm::length(c - d), glm::length(d - b)});
        worst = std::max(worst, glm::length(centre) / shortest);
    }
    return worst;
}

TriangleSurface boundaryOf(const mesh::TetMesh& mesh) {
    struct Face {
        Triangle sorted, outward;
    };
    std::vector<Face> faces;
    faces.reserve(4 * mesh.cells.size());
    for (const auto& cell : mesh.cells)
        for (const auto& local : mesh::faceVertices) {
            Face face{};
            for (std::size_t k = 0; k < 3; ++k) face.outward[k] = cell[static_cast<std::size_t>(local[k])];
            face.sorted = face.outward;
            std::sort(face.sorted.begin(), face.sorted.end());
            faces.push_back(face);
        }
    std::sort(faces.begin(), faces.end(), [](const Face& a, const Face& b) { return a.sorted < b.sorted; });
    TriangleSurface surface;
    surface.points = mesh.positions;
    for (std::size_t i = 0; i < faces.size();) {
        std::size_t end = i + 1;
        while (end < faces.size() && faces[end].sorted == faces[i].sorted) ++end;
        if (end - i == 1) surface.triangles.push_back(faces[i].outward);
        i = end;
    }
    return surface;
}

}  // namespace tetralux::mesher
