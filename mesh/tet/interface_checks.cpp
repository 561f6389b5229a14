// SPDX-License-Identifier: Apache-2.0
#include <mesh/tet/interface_checks.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include <tbb/parallel_for.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <mesh/tet/shared_mark.h>
#include <mesh/tet/triangle_tree.h>

namespace tetralux::mesh {
namespace {

using Corners = TriangleTree::Corners;

/// Faces without a neighbour, as triangles seen from outside, with the points and the cell of each.
struct BoundaryFaces {
    std::vector<Corners> triangles;
    std::vector<std::array<PointIndex, 3>> points;
    std::vector<CellIndex> cells;
    std::vector<glm::dvec3> normals;  ///< unit vectors; zeros if the triangle has no area
    std::vector<double> reaches;      ///< what is nearer than this to a face counts as lying on it
};

glm::dvec3 normalOf(const Corners& t) {
    const glm::dvec3 normal = glm::cross(t[1] - t[0], t[2] - t[0]);
    const double length = glm::length(normal);
    return length > 0.0 ? normal / length : glm::dvec3(0);
}

/// `scale` is the largest coordinate: positions may have been floats.
double reachOf(const Corners& t, double scale) {
    const double edge = std::max({glm::distance(t[0], t[1]), glm::distance(t[1], t[2]), glm::distance(t[2], t[0])});
    return std::min(1e-3 * edge, 1e-6 * edge + 1e-7 * scale);
}

BoundaryFaces collectBoundary(std::span<const glm::dvec3> positions, std::span<const Tetrahedron> cells,
                              const Adjacency& adjacency) {
    BoundaryFaces faces;
    double scale = 0.0;
    for (CellIndex cell = 0; cell < cells.size(); ++cell) {
        for (std::size_t k = 0; k < 4; ++k) {
            if (adjacency.neighbours[cell][k] == Adjacency::noNeighbour) {
                std::array<PointIndex, 3> points;
                Corners corners;
                for (std::size_t v = 0; v < 3; ++v) {
                    points[v] = cells[cell][static_cast<std::size_t>(faceVertices[k][v])];
                    corners[v] = positions[points[v]];
                    scale = std::max(scale, glm::length(corners[v]));
                }
                faces.triangles.push_back(corners);
                faces.points.push_back(points);
                faces.cells.push_back(cell);
            }
        }
    }
    faces.normals.resize(faces.cells.size());
    faces.reaches.resize(faces.cells.size());
    tbb::parallel_for(std::size_t{0}, faces.cells.size(), [&](std::size_t i) {
        faces.normals[i] = normalOf(faces.triangles[i]);
        faces.reaches[i] = reachOf(faces.triangles[i], scale);
    });
    return faces;
}

/// Whether the foot of `x` on the plane of face `i` lies in the inner part of the triangle: a point on an edge touches
/// the face but does not lie on it.
bool liesWithin(const glm::dvec3& x, const BoundaryFaces& faces, std::size_t i) {
    constexpr double inner = 1e-3;  // barycentric
    const Corners& t = faces.triangles[i];
    const glm::dvec3& normal = faces.normals[i];
    const double area = glm::dot(glm::cross(t[1] - t[0], t[2] - t[0]), normal);
    for (std::size_t k = 0; k < 3; ++k) {
        if (!(glm::dot(glm::cross(t[(k + 1) % 3] - x, t[(k + 2) % 3] - x), normal) >= inner * area)) {
            return false;
        }
    }
    return area > 0.0;
}

/// Whether face `i` lies against face `other` from the other side, by its centroid.
bool liesAgainst(const BoundaryFaces& faces, std::size_t i, std::size_t other) {
    const Corners& face = faces.triangles[i];
    const glm::dvec3 centroid = (face[0] + face[1] + face[2]) / 3.0;
    const glm::dvec3& normal = faces.normals[other];
    return std::abs(glm::dot(centroid - faces.triangles[other][0], normal)) <= faces.reaches[i] &&
           glm::dot(faces.normals[i], normal) < 0.0 && liesWithin(centroid, faces, other);
}

/// Whether an edge of face `i` passes through the inner part of face `other`, reaching beyond it on both sides.
bool crosses(const BoundaryFaces& faces, std::size_t i, std::size_t other) {
    const Corners& face = faces.triangles[i];
    const double reach = std::max(faces.reaches[i], faces.reaches[other]);
    std::array<double, 3> above;
    for (std::size_t k = 0; k < 3; ++k) {
        above[k] = glm::dot(face[k] - faces.triangles[other][0], faces.normals[other]);
    }
    for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t next = (k + 1) % 3;
        if (std::min(above[k], above[next]) < -reach && std::max(above[k], above[next]) > reach &&
            liesWithin(face[k] + (face[next] - face[k]) * (above[k] / (above[k] - above[next])), faces, other)) {
            return true;
        }
    }
    return false;
}

/// Marks boundary faces of which one lies against the other (adjacency has joined those with the same points), and
/// those of which one passes through the other. A face that comes near a thousand others is not compared with all of
/// them, or a mesh of nothing but noise would take hours: where it is large and they are small, they find it.
void markPairs(const BoundaryFaces& faces, const TriangleTree& tree, std::vector<std::uint8_t>& gaping,
               std::vector<std::uint8_t>& overlapping) {
    tbb::parallel_for(std::size_t{0}, faces.cells.size(), [&](std::size_t i) {
        constexpr std::size_t mostNear = 1024;
        const Corners& face = faces.triangles[i];
        const glm::dvec3 reach(faces.reaches[i]);
        std::size_t seen = 0;
        tree.forEachInBox(glm::min(glm::min(face[0], face[1]), face[2]) - reach,
                          glm::max(glm::max(face[0], face[1]), face[2]) + reach, [&](std::uint32_t other) {
                              if (other == i) {
                                  return true;
                              }
                              if (liesAgainst(faces, i, other)) {
                                  setMark(gaping[i]);
                                  setMark(gaping[other]);
                              }
                              if (crosses(faces, i, other)) {
                                  setMark(overlapping[i]);
                                  setMark(overlapping[other]);
                              }
                              return ++seen < mostNear;
                          });
    });
}

/// A boundary face of each part of the mesh, parts being joined by points of the boundary.
std::vector<std::uint32_t> oneFaceOfEachPart(const BoundaryFaces& faces, std::size_t pointCount) {
    std::vector<PointIndex> leader(pointCount);
    std::iota(leader.begin(), leader.end(), PointIndex{0});
    const auto find = [&](PointIndex p) {
        while (leader[p] != p) {
            p = leader[p] = leader[leader[p]];
        }
        return p;
    };
    for (const std::array<PointIndex, 3>& face : faces.points) {
        leader[find(face[1])] = find(face[0]);
        leader[find(face[2])] = find(face[0]);
    }
    std::vector<std::uint8_t> seen(pointCount, 0);
    std::vector<std::uint32_t> found;
    for (std::uint32_t i = 0; i < faces.points.size(); ++i) {
        std::uint8_t& before = seen[find(faces.points[i][0])];
        if (before == 0) {
            before = 1;
            found.push_back(i);
        }
    }
    return found;
}

/// How many parts of the mesh `x` lies in, by the faces that a ray from it leaves and enters; nothing if the ray passes
/// too near an edge.
std::optional<int> partsAround(const glm::dvec3& x, const glm::dvec3& direction, const BoundaryFaces& faces,
                               const TriangleTree& tree) {
    int parts = 0;
    bool sure = true;
    tree.forEachAlong(x, direction, 1e300, [&](std::uint32_t i) {
        const Corners& t = faces.triangles[i];
        std::array<double, 3> sides;
        for (std::size_t k = 0; k < 3; ++k) {
            sides[k] = glm::dot(glm::cross(t[(k + 1) % 3] - x, t[(k + 2) % 3] - x), direction);
        }
        const double least = 1e-9 * (std::abs(sides[0]) + std::abs(sides[1]) + std::abs(sides[2]));
        const auto [low, high] = std::minmax_element(sides.begin(), sides.end());
        if (*low<-least&& * high> least) {
            return;  // beside it
        }
        const glm::dvec3& normal = faces.normals[i];
        const bool ahead = (glm::dot(t[0] - x, normal) > 0.0) == (glm::dot(direction, normal) > 0.0);
        sure = sure && (*low > least || *high < -least || !ahead);
        parts += !ahead ? 0 : *low > least ? 1 : *high < -least ? -1 : 0;
    });
    return sure ? std::optional(parts) : std::nullopt;
}

/// Cells of parts that lie inside other parts, whose faces cross nothing.
void addEnclosed(const BoundaryFaces& faces, const TriangleTree& tree, std::span<const glm::dvec3> positions,
                 std::span<const Tetrahedron> cells, std::vector<std::uint8_t>& marked) {
    const std::vector<std::uint32_t> parts = oneFaceOfEachPart(faces, positions.size());
    if (parts.size() < 2) {
        return;
    }
    tbb::parallel_for(std::size_t{0}, parts.size(), [&](std::size_t i) {
        glm::dvec3 centre(0);
        for (const PointIndex p : cells[faces.cells[parts[i]]]) {
            centre += 0.25 * positions[p];
        }
        for (const glm::dvec3& direction :
             {glm::dvec3(0.57, 0.31, 0.76), glm::dvec3(-0.22, 0.87, 0.43), glm::dvec3(0.41, -0.53, -0.74)}) {
            if (const std::optional<int> around = partsAround(centre, direction, faces, tree)) {
                marked[parts[i]] = *around > 1 ? 1 : marked[parts[i]];
                return;
            }
        }
    });
}

/// Calls `use(face, sharing)` for each boundary face that has the points of others: of how many, itself included.
template <class Use>
void forEachShared(const BoundaryFaces& faces, const Use& use) {
    std::vector<std::pair<std::array<PointIndex, 3>, std::uint32_t>> sorted;
    for (std::uint32_t i = 0; i < faces.points.size(); ++i) {
        std::array<PointIndex, 3> points = faces.points[i];
        std::sort(points.begin(), points.end());
        sorted.emplace_back(points, i);
    }
    std::sort(sorted.begin(), sorted.end());
    for (std::size_t first = 0; first < sorted.size();) {
        std::size_t last = first + 1;
        while (last < sorted.size() && sorted[last].first == sorted[first].first) {
            ++last;
        }
        for (std::size_t i = first; i < last && last - first > 1; ++i) {
            use(sorted[i].second, last - first);
        }
        first = last;
    }
}

}  // namespace

std::map<Defect, DefectCount> interfaceDefects(std::span<const glm::dvec3> positions,
                                               std::span<const Tetrahedron> cells, const Adjacency& adjacency) {
    MeshReport report;
    const BoundaryFaces faces = collectBoundary(positions, cells, adjacency);
    std::vector<std::uint8_t> overlapping(faces.cells.size(), 0), gaping(faces.cells.size(), 0);
    if (adjacency.nonManifoldFaces > 0 || adjacency.foldedFaces > 0) {
        forEachShared(faces, [&](std::uint32_t face, std::size_t sharing) {
            if (sharing == 2) {
                overlapping[face] = 1;
            } else {
                report.add(Defect::NonManifoldFace, faces.cells[face]);
            }
        });
    }
    const TriangleTree tree(faces.triangles);
    markPairs(faces, tree, gaping, overlapping);
    addEnclosed(faces, tree, positions, cells, overlapping);
    for (std::size_t i = 0; i < faces.cells.size(); ++i) {
        if (gaping[i] != 0) {
            report.add(Defect::NonConformingInterface, faces.cells[i]);
        }
    }
    std::optional<CellIndex> lastCell;  // faces of one cell stand together
    for (std::size_t i = 0; i < faces.cells.size(); ++i) {
        if (overlapping[i] != 0 && lastCell != faces.cells[i]) {
            lastCell = faces.cells[i];
            report.add(Defect::OverlappingCell, faces.cells[i]);
        }
    }
    if (adjacency.nonManifoldFaces > 0) {
        report.defects[Defect::NonManifoldFace].count = adjacency.nonManifoldFaces;
    }
    return report.defects;
}

}  // namespace tetralux::mesh
