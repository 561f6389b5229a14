// SPDX-License-Identifier: Apache-2.0
#include <mesh/merge_points.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <unordered_map>

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <mesh/equal_items.h>
#include <mesh/orientation.h>
#include <mesh/tet_mesh.h>

namespace tetralux::mesh {
namespace {

using PointRange = tbb::blocked_range<std::size_t>;

std::uint64_t positionHash(const glm::dvec3& x) {
    std::uint64_t hash = 1;
    for (const double c : {x.x, x.y, x.z}) {
        hash = mixed(hash, std::bit_cast<std::uint64_t>(c + 0.0));  // −0 and 0 are one place
    }
    return hash;
}

bool sameValues(const CellSoup& soup, std::size_t a, std::size_t b) {
    for (const Field& field : soup.fields) {
        if (field.association != Association::Point || field.bookkeeping) {
            continue;
        }
        const std::size_t components = static_cast<std::size_t>(field.components);
        for (std::size_t c = 0; c < components; ++c) {
            const double x = field.values[a * components + c];
            const double y = field.values[b * components + c];
            if (x != y && !(std::isnan(x) && std::isnan(y))) {
                return false;
            }
        }
    }
    return true;
}

struct ExactSearch {
    Representatives representatives;
    std::vector<std::uint32_t> jumps;  ///< points that stand for themselves though an earlier one has their position
};

/// Places of a table for points. Those of points that lie near each other are near, because successive points mostly
/// do, and a place at random would miss the caches.
class PointPlaces {
public:
    PointPlaces(const std::vector<glm::dvec3>& points, std::uint64_t slots)
        : slotsPerBox_(slots / (boxes * boxes * boxes)), slots_(slots) {
        constexpr double infinity = std::numeric_limits<double>::infinity();
        const BoundingBox nothing{glm::dvec3(infinity), glm::dvec3(-infinity)};
        const BoundingBox bounds = tbb::parallel_reduce(
            PointRange(0, points.size(), 65536), nothing,
            [&](const PointRange& range, BoundingBox box) {
                for (std::size_t p = range.begin(); p != range.end(); ++p) {
                    if (isFinitePosition(points[p])) {
                        box.low = glm::min(box.low, points[p]);
                        box.high = glm::max(box.high, points[p]);
                    }
                }
                return box;
            },
            [](const BoundingBox& a, const BoundingBox& b) {
                return BoundingBox{glm::min(a.low, b.low), glm::max(a.high, b.high)};
            });
        low_ = bounds.low;
        scale_ = static_cast<double>(boxes) / (bounds.high - bounds.low);
    }

    std::uint64_t operator()(const glm::dvec3& x, std::uint64_t hash) const {
        if (slotsPerBox_ == 0) {
            return placeBelow(slots_, hash);
        }
        const std::uint64_t box = (boxAlong(x, 2) * boxes + boxAlong(x, 1)) * boxes + boxAlong(x, 0);
        return box * slotsPerBox_ + placeBelow(slotsPerBox_, hash);
    }

private:
    static constexpr std::uint64_t boxes = 64;  // along each axis

    std::uint64_t boxAlong(const glm::dvec3& x, int axis) const {
        const double share = (x[axis] - low_[axis]) * scale_[axis];
        return share > 0.0 ? static_cast<std::uint64_t>(std::min(share, static_cast<double>(boxes - 1))) : 0;
    }

    std::uint64_t slotsPerBox_, slots_;
    glm::dvec3 low_{0}, scale_{0};
};

/// Within a run of equal hashes every point is compared with the earlier ones that stand for others.
ExactSearch findEqualPoints(const CellSoup& soup) {
    ExactSearch found{Representatives(soup.points.size()), {}};
    std::iota(found.representatives.begin(), found.representatives.end(), 0u);
    EqualItems items(soup.points.size(), 4);
    const PointPlaces placeOf(soup.points, items.slots());
    tbb::parallel_for(PointRange(0, soup.points.size(), 16384), [&](const PointRange& range) {
        for (std::size_t p = range.begin(); p != range.end(); ++p) {
            const std::uint64_t hash = positionHash(soup.points[p]);
            items.note(static_cast<std::uint32_t>(p), placeOf(soup.points[p], hash), hash,
                       [&](std::uint32_t other) { return soup.points[other] == soup.points[p]; });
        }
    });
    const EqualItems::Pairs equal = items.find();
    std::vector<std::uint32_t> standing;
    forEachRun(equal, [&](std::size_t first, std::size_t last) {
        standing.clear();
        for (std::size_t i = first; i < last; ++i) {
            const std::uint32_t p = equal[i].second;
            bool jumps = false;
            for (const std::uint32_t earlier : standing) {
                if (soup.points[earlier] == soup.points[p]) {
                    if (sameValues(soup, earlier, p)) {
                        found.representatives[p] = earlier;
                        break;
                    }
                    jumps = true;
                }
            }
            if (found.representatives[p] == p) {
                standing.push_back(p);
                if (jumps) {
                    found.jumps.push_back(p);
                }
            }
        }
    });
    std::sort(found.jumps.begin(), found.jumps.end());
    return found;
}

/// Cells of a grid as wide as the tolerance; a point's partners lie in the 27 around it.
class ToleranceGrid {
public:
    ToleranceGrid(const CellSoup& soup, double tolerance) : soup_(soup), tolerance_(tolerance) {}

    std::uint32_t representativeOf(std::uint32_t p) {
        const glm::dvec3 x = soup_.points[p];
        const glm::dvec3 cell = tolerance_ > 0.0 ? glm::floor(x / tolerance_) : x;
        const int reach = tolerance_ > 0.0 ? 1 : 0;
        for (int i = -reach; i <= reach; ++i) {
            for (int j = -reach; j <= reach; ++j) {
                for (int k = -reach; k <= reach; ++k) {
                    const auto [first, last] = cells_.equal_range(positionHash(cell + glm::dvec3(i, j, k)));
                    for (auto at = first; at != last; ++at) {
                        if (glm::distance(soup_.points[at->second], x) <= tolerance_) {
                            return at->second;
                        }
                    }
                }
            }
        }
        cells_.emplace(positionHash(cell), p);
        return p;
    }

private:
    const CellSoup& soup_;
    double tolerance_;
    std::unordered_multimap<std::uint64_t, std::uint32_t> cells_;
};

void renumber(std::vector<std::uint32_t>& points, const Representatives& representatives) {
    tbb::parallel_for(std::size_t{0}, points.size(), [&](std::size_t i) {
        if (points[i] < representatives.size()) {
            points[i] = representatives[points[i]];
        }
    });
}

void renumber(std::vector<std::array<std::uint32_t, 4>>& cells, const Representatives& representatives) {
    tbb::parallel_for(std::size_t{0}, cells.size(), [&](std::size_t i) {
        for (std::uint32_t& p : cells[i]) {
            p = p < representatives.size() ? representatives[p] : p;
        }
    });
}

void renumberPolyhedra(CellSoup& soup, const Representatives& representatives) {
    for (std::size_t at = 0; at < soup.faceStream.size();) {
        const std::size_t points = soup.faceStream[at++];
        for (std::size_t k = 0; k < points && at < soup.faceStream.size(); ++k, ++at) {
            std::uint32_t& p = soup.faceStream[at];
            p = p < representatives.size() ? representatives[p] : p;
        }
    }
}

Representatives searchExactly(const CellSoup& soup, MeshReport& report) {
    ExactSearch found = findEqualPoints(soup);
    for (const std::uint32_t p : found.jumps) {
        report.add(Defect::CoincidentPoint, p);
    }
    return std::move(found.representatives);
}

Representatives searchWithin(const CellSoup& soup, double tolerance, MeshReport& report) {
    if (!(tolerance >= 0.0) || !std::isfinite(tolerance)) {
        throw std::runtime_error(
            fmt::format("merge tolerance {}: is no length; give 0 or a small number of mesh units", tolerance));
    }
    ToleranceGrid grid(soup, tolerance);
    Representatives representatives(soup.points.size());
    for (std::uint32_t p = 0; p < representatives.size(); ++p) {
        representatives[p] = isFinitePosition(soup.points[p]) ? grid.representativeOf(p) : p;
        if (representatives[p] != p) {
            report.add(Defect::CoincidentPoint, p);
        }
    }
    return representatives;
}

}  // namespace

Representatives findCoincidentPoints(const CellSoup& soup, std::optional<double> tolerance, MeshReport& report) {
    Representatives representatives = tolerance ? searchWithin(soup, *tolerance, report) : searchExactly(soup, report);
    std::uint64_t merged = 0;
    for (std::uint32_t p = 0; p < representatives.size(); ++p) {
        merged += representatives[p] != p ? 1 : 0;
    }
    report.pointsMerged += merged;
    return merged > 0 ? std::move(representatives) : Representatives{};
}

void mergePoints(CellSoup& soup, const Representatives& representatives) {
    renumber(soup.connectivity, representatives);
    renumber(soup.tetrahedra, representatives);
    renumberPolyhedra(soup, representatives);
}

}  // namespace tetralux::mesh
