// SPDX-License-Identifier: Apache-2.0
#include <mesh/soup/cone_decomposition.h>

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include <mesh/tet/orientation.h>

namespace tetralux::mesh {
namespace {

using Points = std::vector<glm::dvec3>;

/// Six times the volume within the surface; positive when its triangles turn outwards.
double enclosedSixVolumes(const Points& points, const std::vector<Triangle>& surface) {
    const glm::dvec3 origin = points[surface[0][0]];
    double sum = 0.0;
    for (const Triangle& t : surface) {
        sum += glm::dot(glm::cross(points[t[0]] - origin, points[t[1]] - origin), points[t[2]] - origin);
    }
    return sum;
}

/// Orientation of the tetrahedron between an outward triangle and an apex behind it.
int coneOrientation(const Points& points, const Triangle& t, const glm::dvec3& apex) {
    return orientation(points[t[0]], points[t[2]], points[t[1]], apex);
}

bool touches(const Triangle& t, std::uint32_t p) {
    return t[0] == p || t[1] == p || t[2] == p;
}

std::vector<std::uint32_t>& uniquePoints(const std::vector<Triangle>& surface) {
    thread_local std::vector<std::uint32_t> ids;
    ids.clear();
    for (const Triangle& t : surface) {
        ids.insert(ids.end(), t.begin(), t.end());
    }
    std::sort(ids.begin(), ids.end());
    ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
    return ids;
}

bool seesSurface(const Points& points, const std::vector<Triangle>& surface, std::uint32_t apex) {
    return std::all_of(surface.begin(), surface.end(), [&](const Triangle& t) {
        return touches(t, apex) || coneOrientation(points, t, points[apex]) > 0;
    });
}

bool seesSurface(const Points& points, const std::vector<Triangle>& surface, const glm::dvec3& apex) {
    return std::all_of(surface.begin(), surface.end(),
                       [&](const Triangle& t) { return coneOrientation(points, t, apex) > 0; });
}

glm::dvec3 mean(const Points& points, const std::vector<std::uint32_t>& ids) {
    glm::dvec3 sum(0.0);
    for (const std::uint32_t id : ids) {
        sum += points[id] / static_cast<double>(ids.size());
    }
    return sum;
}

/// Moves `start` behind the plane that it violates most, again and again, until it lies `margin` behind every
/// triangle's plane or the steps are used up: a point of the kernel, if the solid has one wide enough.
glm::dvec3 seekKernel(const Points& points, const std::vector<Triangle>& surface, glm::dvec3 start, double margin) {
    constexpr int steps = 60;
    for (int step = 0; step < steps; ++step) {
        double least = margin;
        glm::dvec3 away(0.0);
        for (const Triangle& t : surface) {
            const glm::dvec3 cross = glm::cross(points[t[1]] - points[t[0]], points[t[2]] - points[t[0]]);
            const double length = glm::length(cross);
            if (!(length > 0.0)) {
                continue;
            }
            const double depth = glm::dot(cross, points[t[0]] - start) / length;
            if (depth < least) {
                least = depth;
                away = -cross / length;
            }
        }
        if (least >= margin) {
            break;
        }
        start += (margin - least) * 1.01 * away;
    }
    return start;
}

/// Weights that sum to 1, give `target` back as their blend of the points, and are nearest to equal: with the mean m
/// and M = Σ (x − m)(x − m)ᵀ, w_i = 1/n + (x_i − m)ᵀ M⁻¹ (target − m). A linear field is then exact at the new point.
void addBlend(const Points& points, const std::vector<std::uint32_t>& ids, const glm::dvec3& target, PointBlends& out) {
    const glm::dvec3 centre = mean(points, ids);
    const double equal = 1.0 / static_cast<double>(ids.size());
    glm::dvec3 slope(0.0);
    if (target != centre) {
        glm::dmat3 spread(0.0);
        for (const std::uint32_t id : ids) {
            const glm::dvec3 r = points[id] - centre;
            spread += glm::outerProduct(r, r);
        }
        slope = glm::inverse(spread) * (target - centre);
    }
    for (const std::uint32_t id : ids) {
        out.addTerm(id, equal + glm::dot(points[id] - centre, slope));
    }
    out.finishPoint();
}

/// A new apex: the mean of the points if that sees the whole surface, else a point sought for.
glm::dvec3 chooseCentre(const Points& points, const std::vector<Triangle>& surface,
                        const std::vector<std::uint32_t>& ids) {
    const glm::dvec3 centre = mean(points, ids);
    if (seesSurface(points, surface, centre)) {
        return centre;
    }
    double size = 0.0;
    for (const std::uint32_t id : ids) {
        size = std::max(size, glm::length(points[id] - centre));
    }
    for (const double margin : {0.05, 0.005, 0.0005}) {
        const glm::dvec3 candidate = seekKernel(points, surface, centre, margin * size);
        if (seesSurface(points, surface, candidate)) {
            return candidate;
        }
    }
    return centre;
}

/// Cone about a new point; its parts that lie inside out are left out. \returns how many these were.
std::size_t coneAboutCentre(const Points& points, const std::vector<Triangle>& surface,
                            const std::vector<std::uint32_t>& ids, ConeOutput& out) {
    const std::uint32_t number = out.firstCentre + static_cast<std::uint32_t>(out.centres.size());
    // The position that the blend gives, not the one asked for, is what the mesh will have.
    PointBlends blend;
    addBlend(points, ids, chooseCentre(points, surface, ids), blend);
    const glm::dvec3 apex = blendedPosition(points, blend, 0);
    const std::size_t before = out.cells.size();
    std::size_t folded = 0;
    for (const Triangle& t : surface) {
        const int side = coneOrientation(points, t, apex);
        if (side > 0) {
            out.cells.push_back({t[0], t[2], t[1], number});
        } else if (side < 0) {
            ++folded;
        }
    }
    if (out.cells.size() > before) {
        out.centres.append(blend);
    }
    return folded;
}

}  // namespace

CellVerdict coneDecomposition(const Points& points, std::vector<Triangle>& surface, bool expectOutward,
                              ConeOutput& out) {
    std::erase_if(surface, [](const Triangle& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; });
    if (surface.size() < 4) {
        return CellVerdict::Flat;
    }
    const bool inward = enclosedSixVolumes(points, surface) < 0.0;
    if (inward) {
        for (Triangle& t : surface) {
            std::swap(t[1], t[2]);
        }
    }
    const CellVerdict whole = inward && expectOutward ? CellVerdict::Inverted : CellVerdict::Good;
    const std::vector<std::uint32_t>& ids = uniquePoints(surface);
    const std::size_t before = out.cells.size();
    for (const std::uint32_t apex : ids) {
        if (seesSurface(points, surface, apex)) {
            for (const Triangle& t : surface) {
                if (!touches(t, apex)) {
                    out.cells.push_back({t[0], t[2], t[1], apex});
                }
            }
            return out.cells.size() > before ? whole : CellVerdict::Flat;
        }
    }
    const std::size_t folded = coneAboutCentre(points, surface, ids, out);
    if (out.cells.size() == before) {
        return CellVerdict::Flat;
    }
    return folded > 0 ? CellVerdict::Folded : whole;
}

}  // namespace tetralux::mesh
