// SPDX-License-Identifier: Apache-2.0
#include <mesh/merge_points.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <stdexcept>
#include <unordered_map>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <mesh/vertex_buckets.h>

namespace tetralux::mesh {
namespace {

using Representatives = std::vector<std::uint32_t>;  ///< the point that stands for each point

bool isFinite(const glm::dvec3& x) { return std::isfinite(x.x) && std::isfinite(x.y) && std::isfinite(x.z); }

std::uint64_t mixed(std::uint64_t hash, std::uint64_t value) {
    hash = (hash ^ value) * 0x9e3779b97f4a7c15ull;
    return hash ^ hash >> 29;
}

std::uint64_t positionHash(const glm::dvec3& x) {
    std::uint64_t hash = 0;
    for (const double c : {x.x, x.y, x.z}) {
        hash = mixed(hash, std::bit_cast<std::uint64_t>(c + 0.0));  // −0 and 0 are one place
    }
    return mixed(hash, hash >> 32);
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
    std::vector<std::uint8_t> jumps;  ///< 1 for a point that shares its position, not its values, with an earlier one
};

/// Buckets by hash of the position; within a bucket every point is compared with the earlier ones that stand for others.
ExactSearch findEqualPoints(const CellSoup& soup) {
    const std::size_t count = soup.points.size();
    const std::size_t buckets = std::bit_ceil(std::max<std::size_t>(count, 1));
    const VertexBuckets<std::uint32_t> places(
        count, buckets, [&](std::size_t p) { return positionHash(soup.points[p]) & (buckets - 1); });
    ExactSearch found{Representatives(count), std::vector<std::uint8_t>(count, 0)};
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, buckets, 4096), [&](const tbb::blocked_range<std::size_t>& range) {
        std::vector<std::uint32_t> bucket;
        for (std::size_t b = range.begin(); b != range.end(); ++b) {
            bucket.clear();
            for (std::size_t slot = places.begin(b); slot < places.end(b); ++slot) {
                bucket.push_back(places.item(slot));
            }
            std::sort(bucket.begin(), bucket.end());
            std::size_t standing = 0;  // bucket[0 … standing) stand for themselves
            for (const std::uint32_t p : bucket) {
                std::uint32_t representative = p;
                for (std::size_t i = 0; i < standing && representative == p; ++i) {
                    if (soup.points[bucket[i]] == soup.points[p]) {
                        const bool same = sameValues(soup, bucket[i], p);
                        representative = same ? bucket[i] : p;
                        found.jumps[p] = same ? found.jumps[bucket[i]] : 1;
                    }
                }
                found.representatives[p] = representative;
                if (representative == p) {
                    bucket[standing++] = p;
                }
            }
        }
    });
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
    for (std::size_t p = 0; p < found.jumps.size(); ++p) {
        if (found.jumps[p] != 0) {
            report.add(Defect::CoincidentPoint, p);
        }
    }
    return std::move(found.representatives);
}

Representatives searchWithin(const CellSoup& soup, double tolerance, MeshReport& report) {
    if (!(tolerance >= 0.0) || !std::isfinite(tolerance)) {
        throw std::runtime_error(fmt::format("merge tolerance {}: is no length; give 0 or a small number of mesh units", tolerance));
    }
    ToleranceGrid grid(soup, tolerance);
    Representatives representatives(soup.points.size());
    for (std::uint32_t p = 0; p < representatives.size(); ++p) {
        representatives[p] = isFinite(soup.points[p]) ? grid.representativeOf(p) : p;
        if (representatives[p] != p) {
            report.add(Defect::CoincidentPoint, p);
        }
    }
    return representatives;
}

}  // namespace

void mergeCoincidentPoints(CellSoup& soup, std::optional<double> tolerance, MeshReport& report) {
    const Representatives representatives = tolerance ? searchWithin(soup, *tolerance, report) : searchExactly(soup, report);
    std::uint64_t merged = 0;
    for (std::uint32_t p = 0; p < representatives.size(); ++p) {
        merged += representatives[p] != p ? 1 : 0;
    }
    report.pointsMerged += merged;
    if (merged > 0) {
        renumber(soup.connectivity, representatives);
        renumberPolyhedra(soup, representatives);
    }
}

}  // namespace tetralux::mesh
