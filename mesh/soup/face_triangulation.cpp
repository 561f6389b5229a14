// SPDX-License-Identifier: Apache-2.0
#include <mesh/soup/face_triangulation.h>

#include <algorithm>

#include <glm/geometric.hpp>

namespace tetralux::mesh {
namespace {

Triangle sorted(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    Triangle t{a, b, c};
    std::sort(t.begin(), t.end());
    return t;
}

/// The polygon from its smallest number on, in the direction of the smaller neighbour. \returns whether it was
/// reversed.
bool makeCanonical(std::vector<std::uint32_t>& polygon) {
    std::rotate(polygon.begin(), std::min_element(polygon.begin(), polygon.end()), polygon.end());
    if (polygon.back() >= polygon[1]) {
        return false;
    }
    std::reverse(polygon.begin() + 1, polygon.end());
    return true;
}

/// Newell's normal: twice the vector area.
glm::dvec3 polygonNormal(const std::vector<glm::dvec3>& points, std::span<const std::uint32_t> polygon) {
    const glm::dvec3 origin = points[polygon[0]];
    glm::dvec3 normal(0.0);
    for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
        normal += glm::cross(points[polygon[i]] - origin, points[polygon[i + 1]] - origin);
    }
    return normal;
}

/// The smallest share of the polygon's area, along its normal, that a triangle of the fan about `root` has.
double smallestShare(const std::vector<glm::dvec3>& points, std::span<const std::uint32_t> polygon, std::size_t root,
                     const glm::dvec3& normal) {
    const std::size_t n = polygon.size();
    const double area = glm::dot(normal, normal);
    const glm::dvec3 origin = points[polygon[root]];
    double smallest = 1.0;
    for (std::size_t i = 1; i + 1 < n; ++i) {
        const glm::dvec3 u = points[polygon[(root + i) % n]] - origin;
        const glm::dvec3 v = points[polygon[(root + i + 1) % n]] - origin;
        smallest = std::min(smallest, glm::dot(glm::cross(u, v), normal) / area);
    }
    return smallest;
}

}  // namespace

FaceTriangulation::FaceTriangulation(const CellSoup& soup, const std::vector<CellVerdict>& verdicts)
    : points_(soup.points) {
    std::vector<bool> onQuad(soup.points.size(), false);
    bool anyQuad = false;
    for (std::size_t cell = 0; cell < verdicts.size(); ++cell) {
        if (!isKept(verdicts[cell]) || soup.types[cell] == cell_type::tetrahedron) {
            continue;
        }
        forEachFace(soup, cell, [&](std::span<const std::uint32_t> face) {
            if (face.size() == 4) {
                anyQuad = true;
                for (const std::uint32_t p : face) {
                    onQuad[p] = true;
                }
            }
        });
    }
    if (!anyQuad) {
        return;
    }
    for (std::size_t cell = 0; cell < verdicts.size(); ++cell) {
        if (!isKept(verdicts[cell]) || soup.types[cell] == cell_type::hexahedron ||
            soup.types[cell] == cell_type::voxel) {
            continue;
        }
        forEachFace(soup, cell, [&](std::span<const std::uint32_t> face) {
            if (face.size() == 3 && onQuad[face[0]] && onQuad[face[1]] && onQuad[face[2]]) {
                interface_.insert(sorted(face[0], face[1], face[2]));
            }
        });
    }
}

bool FaceTriangulation::isInterfaceTriangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
    return interface_.contains(sorted(a, b, c));
}

std::size_t FaceTriangulation::fanRoot(std::span<const std::uint32_t> polygon) const {
    if (polygon.size() == 4 && !interface_.empty()) {
        const int along02 = isInterfaceTriangle(polygon[0], polygon[1], polygon[2]) +
                            isInterfaceTriangle(polygon[0], polygon[2], polygon[3]);
        const int along13 = isInterfaceTriangle(polygon[0], polygon[1], polygon[3]) +
                            isInterfaceTriangle(polygon[1], polygon[2], polygon[3]);
        if (along02 != along13) {
            facesFitted_.fetch_add(1, std::memory_order_relaxed);
            return along02 > along13 ? 0 : 1;
        }
    }
    const glm::dvec3 normal = polygonNormal(points_, polygon);
    constexpr double collinear = 1e-12;  // share of the area below which three points count as collinear
    std::vector<std::size_t> ascending;
    if (smallestShare(points_, polygon, 0, normal) > collinear) {
        return 0;
    }
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        ascending.push_back(i);
    }
    std::sort(ascending.begin(), ascending.end(),
              [&](std::size_t a, std::size_t b) { return polygon[a] < polygon[b]; });
    for (const double least : {collinear, -collinear}) {
        for (const std::size_t root : ascending) {
            if (smallestShare(points_, polygon, root, normal) > least) {
                return root;
            }
        }
    }
    return 0;
}

void FaceTriangulation::cut(std::span<const std::uint32_t> face, std::vector<Triangle>& out) const {
    if (face.size() == 3) {
        out.push_back({face[0], face[1], face[2]});
        return;
    }
    thread_local std::vector<std::uint32_t> polygon;  // no allocation per face: there are tens of millions
    polygon.assign(face.begin(), face.end());
    const bool reversed = makeCanonical(polygon);
    const std::size_t root = fanRoot(polygon);
    const std::size_t n = polygon.size();
    for (std::size_t i = 1; i + 1 < n; ++i) {
        const std::uint32_t second = polygon[(root + i) % n];
        const std::uint32_t third = polygon[(root + i + 1) % n];
        out.push_back(reversed ? Triangle{polygon[root], third, second} : Triangle{polygon[root], second, third});
    }
}

}  // namespace tetralux::mesh
