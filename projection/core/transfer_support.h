// SPDX-License-Identifier: Apache-2.0
/// \file
/// Which scalars a transfer function shows.
#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <preint/exact_integral.h>
#include <preint/transfer_function.h>
#include <preint/value_from_above.h>
#include <projection/core/scene.h>

namespace tetralux::projection {

/// Scalars between `low` and `high` that have extinction; −∞ and ∞ where an outer node has some.
struct ShownScalars {
    double low, high;
    bool lowShows;  ///< so has `low` itself: the extinction jumps up there, and the value at a jump is that from above

    /// Whether a segment over scalars from `least` to `most` has any.
    bool meets(double least, double most) const { return glsl::showsBetween(least, most, low, high, lowShows); }
};

/// All of a function's, ascending, disjoint.
std::vector<ShownScalars> extinctionSupport(const preint::TransferFunction& function);

/// The least (x) and the largest (y) scalar of a cell.
inline glm::dvec2 scalarRange(const mesh::ScalarMesh& mesh, mesh::CellIndex cell) {
    glm::dvec2 range(mesh.scalarAt(cell, 0));
    for (int k = 1; k < 4; ++k) {
        range.x = std::min(range.x, mesh.scalarAt(cell, k));
        range.y = std::max(range.y, mesh.scalarAt(cell, k));
    }
    return range;
}

/// Whether segments with scalars within [low, high] can have opacity.
bool rangeShows(const preint::TransferFunction& function, const std::vector<ShownScalars>& support, double low,
                double high, preint::Integral integral);

/// The colour that all has that can be seen, if there is just one (black when nothing is seen): then the order of cells
/// does not matter.
std::optional<glm::dvec3> onlyColor(const preint::TransferFunction& function);

/// The colour of one scalar that was gathered in float (extreme and mean scalars).
class ScalarColors {
public:
    /// `function` in the units of the scalars (0 … 1). `exact`: they are neither interpolated nor summed, so that one
    /// that is a node's is the same float; then the value at a jump is that from above.
    ScalarColors(const preint::TransferFunction& function, bool exact);

    glm::dvec3 at(float scalar) const { return function_.colorAt(static_cast<double>(scalar)); }

    /// Whether rounding of the scalar may show.
    bool isUncertain(float scalar) const;

private:
    preint::TransferFunction function_;  // its nodes rounded as scalars are
    std::vector<glm::vec2> uncertain_;   // ascending, disjoint: scalars near which the colour changes steeply
};

/// Which cells of a mesh show anything at all.
class CellVisibility {
public:
    CellVisibility(const mesh::ScalarMesh& mesh, const preint::TransferFunction& function,
                   const RenderSettings& settings);

    /// False where the cell's opacity is zero or, but in modes that take any opacity for something and where it is made
    /// larger (silhouettes, factors of extinction), at most half of float's step at 1 along any ray: it would change no
    /// opaque pixel, and others by less than float's own error.
    bool shows(mesh::CellIndex cell) const;

private:
    const mesh::ScalarMesh& mesh_;
    preint::Integral integral_;
    preint::ExactIntegral exact_;
    std::vector<ShownScalars> support_;
    double leastDepth_;
};

}  // namespace tetralux::projection
