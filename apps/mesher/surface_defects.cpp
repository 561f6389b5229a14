// SPDX-License-Identifier: Apache-2.0
#include "surface_defects.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <numbers>
#include <numeric>
#include <set>

namespace tetralux::mesher {
namespace {

using std::uint32_t;
using std::uint64_t;

/// A triangle's side from `from` to `to`.
struct HalfEdge {
    uint32_t low, high;  // sorted, to bring both directions together
    uint32_t triangle;
    bool upward;  // from low to high
    friend bool operator<(const HalfEdge& a, const HalfEdge& b) {
        return std::tie(a.low, a.high, a.triangle) < std::tie(b.low, b.high, b.triangle);
    }
};

std::string place(const glm::dvec3& p) {
    return fmt::format("({:.6g}, {:.6g}, {:.6g})", p.x, p.y, p.z);
}

bool isFinite(const glm::dvec3& p) {
    return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

/// Exactly flat: the three coordinate projections all have no area. Rounded differences make this a test in doubles;
/// what it misses, the check by CGAL's exact predicates finds.
bool degenerate(const TriangleSurface& surface, const Triangle& t) {
    if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) return true;
    const glm::dvec3 a = surface.points[t[1]] - surface.points[t[0]], b = surface.points[t[2]] - surface.points[t[0]];
    const glm::dvec3 n = glm::cross(a, b);
    return n.x == 0.0 && n.y == 0.0 && n.z == 0.0;
}

/// Adds one to the finding of that defect, whose first place `where` tells.
template <class Where>
void count(SurfaceFindings& findings, SurfaceDefect defect, const Where& where) {
    const auto found =
        std::find_if(findings.begin(), findings.end(), [&](const auto& f) { return f.defect == defect; });
    if (found != findings.end())
        ++found->count;
    else
        findings.push_back({defect, 1, where()});
}

void checkPoints(const TriangleSurface& surface, SurfaceFindings& findings) {
    std::vector<bool> seen(surface.points.size(), false);
    for (const Triangle& t : surface.triangles)
        for (const uint32_t i : t) {
            if (seen[i] || isFinite(surface.points[i])) continue;
            seen[i] = true;
            count(findings, SurfaceDefect::NonFinitePoint, [&] { return fmt::format("point {}", i); });
        }
}

void checkTriangles(const TriangleSurface& surface, SurfaceFindings& findings) {
    std::vector<std::pair<Triangle, uint32_t>> sorted;
    sorted.reserve(surface.triangles.size());
    for (uint32_t i = 0; i < surface.triangles.size(); ++i) {
        Triangle t = surface.triangles[i];
        if (degenerate(surface, t))
            count(findings, SurfaceDefect::DegenerateTriangle,
                  [&] { return fmt::format("triangle {} near {}", i, place(surface.points[t[0]])); });
        std::sort(t.begin(), t.end());
        sorted.emplace_back(t, i);
    }
    std::sort(sorted.begin(), sorted.end());
    for (std::size_t i = 1; i < sorted.size(); ++i)
        if (sorted[i].first == sorted[i - 1].first)
            count(findings, SurfaceDefect::DuplicateTriangle,
                  [&] { return fmt::format("triangles {} and {}", sorted[i - 1].second, sorted[i].second); });
}

/// Loops of border edges, by joining edges that share a point (two holes that touch in a point count as one).
void countHoles(const TriangleSurface& surface, const std::vector<std::pair<uint32_t, uint32_t>>& border,
                SurfaceFindings& findings) {
    std::map<uint32_t, uint32_t> parent;
    const auto root = [&](uint32_t i) {
        parent.emplace(i, i);
        while (parent[i] != i) i = parent[i] = parent[parent[i]];
        return i;
    };
    for (const auto& [a, b] : border) {
        const uint32_t rootOfA = root(a);
        parent[rootOfA] = root(b);
    }
    std::map<uint32_t, uint64_t> edges;
    for (const auto& [a, b] : border) ++edges[root(a)];
    const auto largest =
        std::max_element(edges.begin(), edges.end(), [](const auto& x, const auto& y) { return x.second < y.second; });
    if (largest == edges.end()) return;
    findings.push_back({SurfaceDefect::Hole, edges.size(),
                        fmt::format("{}{} edges, near {}", edges.size() == 1 ? "" : "the largest: ", largest->second,
                                    place(surface.points[largest->first]))});
}

void checkEdges(const TriangleSurface& surface, SurfaceFindings& findings) {
    std::vector<HalfEdge> sides;
    sides.reserve(3 * surface.triangles.size());
    for (uint32_t i = 0; i < surface.triangles.size(); ++i)
        for (std::size_t k = 0; k < 3; ++k) {
            const uint32_t a = surface.triangles[i][k], b = surface.triangles[i][(k + 1) % 3];
            if (a != b) sides.push_back({std::min(a, b), std::max(a, b), i, a < b});
        }
    std::sort(sides.begin(), sides.end());
    std::vector<std::pair<uint32_t, uint32_t>> border;
    for (std::size_t first = 0; first < sides.size();) {
        std::size_t end = first;
        while (end < sides.size() && sides[end].low == sides[first].low && sides[end].high == sides[first].high) ++end;
        const auto edge = [&] {
            return fmt::format("points {} and {} near {}", sides[first].low, sides[first].high,
                               place(surface.points[sides[first].low]));
        };
        if (end - first == 1) border.emplace_back(sides[first].low, sides[first].high);
        if (end - first > 2) count(findings, SurfaceDefect::NonManifoldEdge, edge);
        if (end - first == 2 && sides[first].upward == sides[first + 1].upward)
            count(findings, SurfaceDefect::InconsistentEdge, edge);
        first = end;
    }
    countHoles(surface, border, findings);
}

std::string text(const DefectFinding& finding) {
    const bool one = finding.count == 1;
    const auto say = [&](const char* single, const char* many) {
        return fmt::format("{} {} ({}{})", finding.count, one ? single : many,
                           one || finding.defect == SurfaceDefect::Hole ? "" : "first: ", finding.where);
    };
    switch (finding.defect) {
        case SurfaceDefect::NonFinitePoint:
            return say("point with a NaN or infinite coordinate", "points with NaN or infinite coordinates");
        case SurfaceDefect::DegenerateTriangle:
            return say("degenerate triangle", "degenerate triangles");
        case SurfaceDefect::DuplicateTriangle:
            return say("triangle given twice", "triangles given twice");
        case SurfaceDefect::NonManifoldEdge:
            return say("non-manifold edge with more than two triangles",
                       "non-manifold edges with more than two triangles");
        case SurfaceDefect::InconsistentEdge:
            return say("edge whose triangles are oriented against each other",
                       "edges whose triangles are oriented against each other");
        case SurfaceDefect::Hole:
            return say("hole", "holes");
        case SurfaceDefect::SelfIntersection:
            return say("self-intersection", "self-intersections");
        case SurfaceDefect::WrongSide:
            return say("shell oriented to the wrong side", "shells oriented to the wrong side");
    }
    return "an unknown defect";
}

}  // namespace

std::string describe(const SurfaceFindings& findings) {
    std::string line;
    for (const DefectFinding& finding : findings) line += (line.empty() ? "" : ", ") + text(finding);
    return line;
}

std::string remedy(const SurfaceFindings& findings) {
    const auto has = [&](SurfaceDefect d) {
        return std::any_of(findings.begin(), findings.end(), [&](const auto& f) { return f.defect == d; });
    };
    if (has(SurfaceDefect::NonFinitePoint)) return "--repair drops the triangles there and fills the holes";
    if (has(SurfaceDefect::SelfIntersection) || has(SurfaceDefect::NonManifoldEdge))
        return "move the triangles apart in a modelling program, or let --repair try";
    if (has(SurfaceDefect::Hole)) return "--repair fills holes";
    return "--repair mends this";
}

SurfaceFindings checkTopology(const TriangleSurface& surface) {
    SurfaceFindings findings;
    checkPoints(surface, findings);
    if (!findings.empty()) return findings;
    checkTriangles(surface, findings);
    checkEdges(surface, findings);
    return findings;
}

uint64_t mergeCoincidentPoints(TriangleSurface& surface) {
    const auto& points = surface.points;
    std::vector<uint32_t> order(points.size());
    std::iota(order.begin(), order.end(), 0u);
    const auto key = [&](uint32_t i) { return std::tie(points[i].x, points[i].y, points[i].z); };
    const auto finite = std::partition(order.begin(), order.end(), [&](uint32_t i) { return isFinite(points[i]); });
    std::sort(order.begin(), finite, [&](uint32_t a, uint32_t b) {
        return std::tuple_cat(key(a), std::tie(a)) < std::tuple_cat(key(b), std::tie(b));
    });

    std::vector<uint32_t> keeper(points.size());
    std::iota(keeper.begin(), keeper.end(), 0u);
    for (auto i = order.begin(); i != finite; ++i)
        if (i != order.begin() && key(*i) == key(*(i - 1))) keeper[*i] = keeper[*(i - 1)];

    std::vector<uint32_t> newIndex(points.size());
    std::vector<glm::dvec3> kept;
    std::vector<mesh::Field> fields = surface.fields;
    for (auto& field : fields) field.values.clear();
    for (uint32_t i = 0; i < points.size(); ++i) {
        if (keeper[i] != i) continue;
        newIndex[i] = static_cast<uint32_t>(kept.size());
        kept.push_back(points[i]);
        for (std::size_t f = 0; f < fields.size(); ++f) {
            const auto n = static_cast<std::ptrdiff_t>(fields[f].components);
            const auto from = surface.fields[f].values.begin() + static_cast<std::ptrdiff_t>(i) * n;
            fields[f].values.insert(fields[f].values.end(), from, from + n);
        }
    }
    const uint64_t merged = points.size() - kept.size();
    for (Triangle& t : surface.triangles)
        for (uint32_t& i : t) i = newIndex[keeper[i]];
    surface.points = std::move(kept);
    surface.fields = std::move(fields);
    return merged;
}

double enclosedVolume(const TriangleSurface& surface) {
    if (surface.triangles.empty()) return 0.0;
    const glm::dvec3 origin =
        surface.points[surface.triangles[0][0]];  // near the surface, so that large offsets cancel nothing
    double sum = 0.0, lost = 0.0;                 // Kahan's sum
    for (const Triangle& t : surface.triangles) {
        const glm::dvec3 a = surface.points[t[0]] - origin, b = surface.points[t[1]] - origin,
                         c = surface.points[t[2]] - origin;
        const double term = glm::dot(glm::cross(a, b), c) - lost;
        const double next = sum + term;
        lost = (next - sum) - term;
        sum = next;
    }
    return sum / 6.0;
}

double windingNumber(const TriangleSurface& surface, const glm::dvec3& p) {
    double angle = 0.0;
    for (const Triangle& t : surface.triangles) {
        const glm::dvec3 a = surface.points[t[0]] - p, b = surface.points[t[1]] - p, c = surface.points[t[2]] - p;
        const double la = glm::length(a), lb = glm::length(b), lc = glm::length(c);
        angle += 2.0 * std::atan2(glm::dot(a, glm::cross(b, c)),
                                  la * lb * lc + glm::dot(a, b) * lc + glm::dot(b, c) * la + glm::dot(c, a) * lb);
    }
    return angle / (4.0 * std::numbers::pi);
}

}  // namespace tetralux::mesher
