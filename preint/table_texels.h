// SPDX-License-Identifier: Apache-2.0
/// \file
/// The content of single texels, straight from the exact integral: what builders fill in and what the choice of a size
/// looks at before anything is built.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

#include <preint/preintegration_table.h>

namespace tetralux::preint {

/// Texels of a table with the given layout (zones, size, slices, length axis); its own `texels` need not exist. Neither
/// argument is copied.
class TableTexels {
public:
    TableTexels(const ExactIntegral& exact, const PreintegrationTable& layout);

    /// Front texel `i`, back texel `row` = zone·size + j, slice `k`: (mean colour, mean extinction).
    glm::vec4 texel(int i, int row, int k) const;

    double lengthOf(int slice) const;  ///< mesh units; the first slice stands for the limit of no length

    /// The entry of a segment from its integral over optical depth per `path` (scalar difference or length).
    glm::vec4 entry(const SegmentResult& segment, double path, double front, double back, const glm::dvec2& zone) const;

    /// The entry of a single scalar within its zone.
    glm::vec4 diagonal(double scalar, const glm::dvec2& zone) const;

private:
    const ExactIntegral& exact_;
    const PreintegrationTable& layout_;
    double thinLength_;  // so short that the mean colour has reached its limit
};

}  // namespace tetralux::preint
