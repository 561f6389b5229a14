// SPDX-License-Identifier: Apache-2.0
#include <mesh/soup/merge_points.h>

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
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <mesh/tet/equal_items.h>
#include <mesh/tet/orientation.h>
#include <mesh/tet/tet_mesh.h>

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

/// A hash of what `sameValues` compares.
std::uint64_t valuesHash(const CellSoup& soup, std::size_t p) {
    std::uint64_t hash = 1;
    for (const Field& field : soup.fields) {
        if (field.association == Association::Point && !field.bookkeeping) {
            const std::size_t components = static_cast<std::size_t>(field.components);
            for (std::size_t c = 0; c < components; ++c) {
                const double value = field.values[p * components + c];
                hash = mixed(hash, std::isnan(value) ? 1 : std::bit_cast<std::uint64_t>(value + 0.0));
            }
        }
    }
    return hash;
}

/// Hash and number of every finite point, sorted, whose position another one has, and of some others.
EqualItems::Pairs findEqualPositions(const std::vector<glm::dvec3>& points) {
    EqualItems items(points.size(), 0);
    const auto keyOf = [&](std::uint32_t p) {
        const std::uint64_t hash = positionHash(points[p]);
        const std::uint64_t place = placeBelow(items.places(), hash);
        return EqualItems::Key{place, place, hash};
    };
    tbb::parallel_for(PointRange(0, points.size(), 16384), [&](const PointRange& range) {
        for (std::size_t p = range.begin(); p != range.end(); ++p) {
            if (isFinitePosition(points[p])) {
                items.note(keyOf(static_cast<std::uint32_t>(p)));
            }
        }
    });
    const auto groupOf = [&](std::uint32_t p) {
        return isFinitePosition(points[p]) ? keyOf(p).group : EqualItems::noGroup;
    };
    return items.find(points.size(), groupOf, keyOf);
}

/// Within a run of equal hashes every point is compared with the earlier ones that stand for others.
class ExactSearch {
public:
    explicit ExactSearch(const CellSoup& soup) : soup_(soup) {
        const EqualItems::Pairs equal = findEqualPositions(soup.points);
        forEachRun(equal, [&](std::size_t first, std::size_t last) {
            standing_.clear();
            positions_.clear();
            for (std::size_t i = first; i < last; ++i) {
                place(equal[i].second);
            }
        });
        std::sort(jumps_.begin(), jumps_.end());
    }

    Representatives takeRepresentatives() { return std::move(representatives_); }
    /// Points that stand for themselves though an earlier one has their position.
    const std::vector<std::uint32_t>& jumps() const { return jumps_; }

private:
    void place(std::uint32_t p) {
        std::vector<std::uint32_t>& earlierOnes = standing_[valuesHash(soup_, p)];
        for (const std::uint32_t earlier : earlierOnes) {
            if (soup_.points[earlier] == soup_.points[p] && sameValues(soup_, earlier, p)) {
                if (representatives_.empty()) {
                    representatives_.resize(soup_.points.size());
                    std::iota(representatives_.begin(), representatives_.end(), 0u);
                }
                representatives_[p] = earlier;
                return;
            }
        }
        earlierOnes.push_back(p);
        const auto isHere = [&](const glm::dvec3& x) { return x == soup_.points[p]; };
        if (std::any_of(positions_.begin(), positions_.end(), isHere)) {
            jumps_.push_back(p);
        } else {
            positions_.push_back(soup_.points[p]);
        }
    }

    const CellSoup& soup_;
    Representatives representatives_;
    std::vector<std::uint32_t> jumps_;
    std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> standing_;  // by the hash of their values
    std::vector<glm::dvec3> positions_;                                       // of those, each once
};

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
    ExactSearch found(soup);
    for (const std::uint32_t p : found.jumps()) {
        report.add(Defect::CoincidentPoint, p);
    }
    return found.takeRepresentatives();
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
