// SPDX-License-Identifier: Apache-2.0
#include <mesh/soup/subdivide_cells.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <span>
#include <tuple>
#include <unordered_map>
#include <utility>

#include <mesh/soup/cell_types.h>
#include <mesh/soup/point_blend.h>
#include <mesh/soup/reference_lattice.h>
#include <mesh/soup/shape_functions.h>

namespace tetralux::mesh {
namespace {

/// How every curved cell of one type and number of points is cut.
struct Pattern {
    ReferenceLattice lattice;
    std::vector<std::vector<double>> weights;  ///< of the cell's points, per lattice point
    std::vector<int> ownPoint;                 ///< the cell's point that a lattice point is, or −1
};

/// The point of the cell on which all weight rests, or −1.
int onlyPoint(const std::vector<double>& weights) {
    constexpr double roundoff = 1e-9;
    const auto heaviest = std::max_element(weights.begin(), weights.end());
    const bool alone =
        std::abs(*heaviest - 1.0) < roundoff &&
        std::count_if(weights.begin(), weights.end(), [](double w) { return std::abs(w) > roundoff; }) == 1;
    return alone ? static_cast<int>(heaviest - weights.begin()) : -1;
}

Pattern makePattern(std::uint8_t type, std::size_t pointCount, int segments) {
    Pattern pattern;
    pattern.lattice = referenceLattice(cellTypeInfo(type).shape, segments);
    pattern.weights = shapeFunctions(type, pointCount, pattern.lattice.points);
    for (const std::vector<double>& row : pattern.weights) {
        pattern.ownPoint.push_back(onlyPoint(row));
    }
    return pattern;
}

/// A place on an edge or face, the same from every cell that has it: its corners with their weights in units of 2⁻⁴⁰,
/// sorted by corner. At most four corners; unused ones are `invalidPoint`.
using Place = std::array<std::pair<std::uint32_t, std::uint64_t>, 4>;

struct PlaceHash {
    std::size_t operator()(const Place& place) const {
        std::size_t hash = 0;
        for (const auto& [corner, weight] : place) {
            hash = (hash ^ corner) * 0x9e3779b97f4a7c15ull;
            hash = (hash ^ weight ^ hash >> 29) * 0xbf58476d1ce4e5b9ull;
        }
        return hash ^ hash >> 32;
    }
};

class Subdivision {
public:
    Subdivision(CellSoup& soup, int segments) : soup_(soup), segments_(segments) {}

    /// Cuts `cell`. \returns false if its type has no order for its number of points.
    bool cut(std::size_t cell) {
        const std::span<const std::uint32_t> points(soup_.connectivity.data() + soup_.offsets[cell],
                                                    soup_.connectivity.data() + soup_.offsets[cell + 1]);
        const Pattern* pattern = patternFor(soup_.types[cell], points.size());
        if (pattern == nullptr) {
            return false;
        }
        std::vector<std::uint32_t>& numbers = numbers_;
        numbers.clear();
        for (std::size_t i = 0; i < pattern->weights.size(); ++i) {
            numbers.push_back(pattern->ownPoint[i] >= 0 ? points[static_cast<std::size_t>(pattern->ownPoint[i])]
                                                        : latticePoint(*pattern, i, points));
        }
        for (const ReferenceLattice::SubCell& sub : pattern->lattice.cells) {
            std::array<std::uint32_t, 8> ids{};
            for (std::size_t k = 0; k < static_cast<std::size_t>(sub.pointCount); ++k) {
                ids[k] = numbers[static_cast<std::size_t>(sub.points[k])];
            }
            add(sub.type, std::span(ids.data(), static_cast<std::size_t>(sub.pointCount)), cell);
        }
        return true;
    }

    /// Takes a linear cell over as it is.
    void keep(std::size_t cell) {
        const std::uint8_t type = soup_.types[cell];
        add(type,
            std::span<const std::uint32_t>(soup_.connectivity.data() + soup_.offsets[cell],
                                           soup_.connectivity.data() + soup_.offsets[cell + 1]),
            cell);
        if (type == cell_type::polyhedron) {
            faceStream_.insert(faceStream_.end(),
                               soup_.faceStream.begin() + static_cast<std::ptrdiff_t>(soup_.faceOffsets[cell]),
                               soup_.faceStream.begin() + static_cast<std::ptrdiff_t>(soup_.faceOffsets[cell + 1]));
            faceOffsets_.back() = faceStream_.size();
        }
    }

    /// Puts the new cells and points in place of the old. \returns their parents.
    std::vector<std::uint32_t> finish() {
        soup_.types = std::move(cells_.types);
        soup_.offsets = std::move(cells_.offsets);
        soup_.connectivity = std::move(cells_.connectivity);
        if (!soup_.faceOffsets.empty()) {
            soup_.faceOffsets = std::move(faceOffsets_);
            soup_.faceStream = std::move(faceStream_);
        }
        soup_.hidden.clear();
        appendBlendedPoints(soup_, newPoints_);
        return std::move(parents_);
    }

private:
    const Pattern* patternFor(std::uint8_t type, std::size_t pointCount) {
        const auto key = std::make_pair(type, pointCount);
        if (const auto found = patterns_.find(key); found != patterns_.end()) {
            return &found->second;
        }
        const std::optional<int> order = curvedCellOrder(type, pointCount);
        if (!order) {
            return nullptr;
        }
        return &patterns_.emplace(key, makePattern(type, pointCount, segments_ > 0 ? segments_ : *order)).first->second;
    }

    std::uint32_t latticePoint(const Pattern& pattern, std::size_t i, std::span<const std::uint32_t> points) {
        const std::vector<double>& corners = pattern.lattice.cornerWeights[i];
        Place place;
        place.fill({CellSoup::invalidPoint, 0});
        std::size_t count = 0;
        for (std::size_t c = 0; c < corners.size(); ++c) {
            if (corners[c] > 1e-9 && count++ < place.size()) {
                place[count - 1] = {points[c], static_cast<std::uint64_t>(std::llround(corners[c] * 0x1p40))};
            }
        }
        if (count == corners.size() || count > place.size()) {
            return newPoint(pattern.weights[i], points);  // inside the cell: no other has it
        }
        std::sort(place.begin(), place.end());
        const auto [found, isNew] = shared_.try_emplace(place, 0);
        if (isNew) {
            found->second = newPoint(pattern.weights[i], points);
        }
        return found->second;
    }

    std::uint32_t newPoint(const std::vector<double>& weights, std::span<const std::uint32_t> points) {
        for (std::size_t k = 0; k < points.size(); ++k) {
            if (weights[k] != 0.0) {
                newPoints_.addTerm(points[k], weights[k]);
            }
        }
        newPoints_.finishPoint();
        return static_cast<std::uint32_t>(soup_.points.size() + newPoints_.size() - 1);
    }

    void add(std::uint8_t type, std::span<const std::uint32_t> points, std::size_t parent) {
        appendCell(cells_, type, points);
        parents_.push_back(static_cast<std::uint32_t>(parent));
        faceOffsets_.push_back(faceStream_.size());
    }

    CellSoup& soup_;
    int segments_;
    std::map<std::pair<std::uint8_t, std::size_t>, Pattern> patterns_;
    std::unordered_map<Place, std::uint32_t, PlaceHash> shared_;
    PointBlends newPoints_;
    CellSoup cells_;  ///< only its cell arrays are used
    std::vector<std::uint64_t> faceOffsets_{0};
    std::vector<std::uint32_t> faceStream_;
    std::vector<std::uint32_t> parents_;
    std::vector<std::uint32_t> numbers_;
};

bool isCurved(std::uint8_t type) {
    const CellTypeInfo info = cellTypeInfo(type);
    return !info.linear && info.shape != Shape::None;
}

}  // namespace

std::optional<std::vector<std::uint32_t>> subdivideCurvedCells(CellSoup& soup, std::vector<CellVerdict>& verdicts,
                                                               int segments) {
    if (std::none_of(soup.types.begin(), soup.types.end(), isCurved)) {
        return std::nullopt;
    }
    Subdivision subdivision(soup, segments);
    for (std::size_t cell = 0; cell < verdicts.size(); ++cell) {
        if (!isKept(verdicts[cell])) {
            continue;
        }
        if (!isCurved(soup.types[cell])) {
            subdivision.keep(cell);
        } else if (!subdivision.cut(cell)) {
            verdicts[cell] = CellVerdict::Unsupported;
        }
    }
    return subdivision.finish();
}

}  // namespace tetralux::mesh
