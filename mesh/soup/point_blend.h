// SPDX-License-Identifier: Apache-2.0
/// \file
/// New points as weighted sums of old ones, so that positions and every point field follow by one rule.
#pragma once

#include <cstdint>
#include <vector>

#include <mesh/soup/cell_soup.h>

namespace tetralux::mesh {

/// Blend i is the sum of weights[k] times point ids[k] over k in [ends[i − 1], ends[i]). Weights sum to 1.
struct PointBlends {
    std::vector<std::uint64_t> ends;
    std::vector<std::uint32_t> ids;
    std::vector<double> weights;

    std::size_t size() const { return ends.size(); }
    void addTerm(std::uint32_t id, double weight) {
        ids.push_back(id);
        weights.push_back(weight);
    }
    void finishPoint() { ends.push_back(ids.size()); }
    void append(const PointBlends& other);
};

/// Position of blend `i`.
glm::dvec3 blendedPosition(const std::vector<glm::dvec3>& points, const PointBlends& blends, std::size_t i);

/// Adds the blended points, with all point fields, behind the points of `soup`. Every id must be in range.
void appendBlendedPoints(CellSoup& soup, const PointBlends& blends);

}  // namespace tetralux::mesh
