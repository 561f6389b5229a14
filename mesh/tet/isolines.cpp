// SPDX-License-Identifier: Apache-2.0
#include <mesh/tet/isolines.h>

#include <algorithm>
#include <unordered_map>

#include <glm/common.hpp>

namespace tetralux::mesh {

namespace {

class IsolineFinder {
public:
    IsolineFinder(const SurfaceMesh& surface, const std::vector<double>& values) : surface_(surface), values_(values) {}

    /// The level through one triangle with a linear scalar.
    void crossTriangle(const std::array<PointIndex, 3>& corners) {
        const auto [low, high] =
            std::minmax({surface_.scalars[corners[0]], surface_.scalars[corners[1]], surface_.scalars[corners[2]]});
        forEachBetween(low, high, [&](std::uint32_t number) {
            std::array<glm::dvec3, 2> ends{};
            std::size_t count = 0;
            for (std::size_t k = 0; k < 3; ++k) {
                const PointIndex a = corners[k], b = corners[(k + 1) % 3];
                if (isBelow(a, number) != isBelow(b, number)) ends[count++] = crossing(a, b, number);
            }
            if (ends[0] != ends[1]) found_.push_back({ends[0], ends[1], number});
        });
    }

    /// The edge between two triangles that have one scalar each.
    void crossEdge(PointIndex a, PointIndex b, double oneSide, double other) {
        forEachBetween(std::min(oneSide, other), std::max(oneSide, other), [&](std::uint32_t number) {
            found_.push_back({surface_.positions[a], surface_.positions[b], number});
        });
    }

    std::vector<IsolineSegment> take() { return std::move(found_); }

private:
    /// Values with low < v ≤ high.
    template <class Use>
    void forEachBetween(double low, double high, const Use& use) const {
        auto at = std::upper_bound(values_.begin(), values_.end(), low);
        for (; at != values_.end() && *at <= high; ++at) use(static_cast<std::uint32_t>(at - values_.begin()));
    }

    bool isBelow(PointIndex point, std::uint32_t number) const { return surface_.scalars[point] < values_[number]; }

    /// The same from both sides of the edge.
    glm::dvec3 crossing(PointIndex a, PointIndex b, std::uint32_t number) const {
        const auto [low, high] = std::minmax(a, b);
        const double atLow = surface_.scalars[low], atHigh = surface_.scalars[high];
        return glm::mix(surface_.positions[low], surface_.positions[high],
                        (values_[number] - atLow) / (atHigh - atLow));
    }

    const SurfaceMesh& surface_;
    const std::vector<double>& values_;
    std::vector<IsolineSegment> found_;
};

}  // namespace

std::vector<IsolineSegment> isolines(const SurfaceMesh& surface, const std::vector<double>& values) {
    IsolineFinder finder(surface, values);
    if (surface.scalars.empty()) return {};
    if (surface.association == Association::Point) {
        for (const auto& corners : surface.triangles) finder.crossTriangle(corners);
        return finder.take();
    }
    std::unordered_map<std::uint64_t, double> waiting;  // edges that one triangle has been met at, and its scalar
    for (std::size_t i = 0; i < surface.triangles.size(); ++i)
        for (std::size_t k = 0; k < 3; ++k) {
            const auto [a, b] = std::minmax(surface.triangles[i][k], surface.triangles[i][(k + 1) % 3]);
            const auto [found, isNew] = waiting.try_emplace(std::uint64_t{a} << 32 | b, surface.scalars[i]);
            if (isNew) continue;
            finder.crossEdge(a, b, found->second, surface.scalars[i]);
            waiting.erase(found);
        }
    return finder.take();
}

}  // namespace tetralux::mesh
