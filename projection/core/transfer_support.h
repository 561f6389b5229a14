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
#include <projection/core/scene.h>

namespace tetralux::projection {

/// The open intervals of scalars (low, high) with extinction, ascending, disjoint; −∞ and ∞ where an outer node has
/// extinction. A low end at which the extinction jumps up holds itself (the value there is that from above): it is
/// moved down by the least step of double.
std::vector<glm::dvec2> extinctionSupport(const preint::TransferFunction& function);

/// The same for who compares floats: such ends are moved down by 1e-7 of the nodes' range.
std::vector<glm::vec2> floatExtinctionSupport(const preint::TransferFunction& function);

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
bool rangeShows(const preint::TransferFunction& function, const std::vector<glm::dvec2>& support, double low,
                double high, preint::Integral integral);

/// The colour that all has that can be seen, if there is just one (black when nothing is seen): then the order of cells
/// does not matter.
std::optional<glm::dvec3> onlyColor(const preint::TransferFunction& function);

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
    std::vector<glm::dvec2> support_;
    double leastDepth_;
};

}  // namespace tetralux::projection
