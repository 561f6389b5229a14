// SPDX-License-Identifier: Apache-2.0
/// \file
/// One cell on one ray, in double precision.
#pragma once

#include <algorithm>
#include <array>
#include <optional>

#include <projection/cells/projected_cell.h>
#include <projection/cells/ray_triangle.h>
#include <projection/reference/reference_ray_caster.h>

namespace tetralux::projection {

/// Where the ray passes a face.
struct Crossing {
    double t, scalar;
    bool enters;
};

/// The corners of a cell in the order of their point numbers, seen along a ray, and on which side its edges pass. Both
/// cells of a face get the same numbers to the bit, so an isosurface on the face is crossed in exactly one of them.
class SeenCell {
public:
    /// False where the ray's line passes beside all corners.
    bool see(const RayFrame& ray, const mesh::ScalarMesh& mesh, mesh::CellIndex cell) {
        const mesh::Tetrahedron& points = mesh.cells[cell];
        odd_ = single_cell::sortedCorners(points, order_);
        for (std::size_t k = 0; k < 4; ++k) v_[k] = ray.see(mesh.positions[points[order_[k]]]);
        for (int axis = 0; axis < 2; ++axis) {
            const auto [low, high] =
                std::minmax({v_[0].across[axis], v_[1].across[axis], v_[2].across[axis], v_[3].across[axis]});
            if (low > 0 || high < 0) return false;
        }
        for (std::size_t i = 0; i < 4; ++i) {
            s_[i] = mesh.scalarAt(cell, static_cast<int>(order_[i]));
            for (std::size_t j = i + 1; j < 4; ++j) {
                side_[i][j] = edgeSide(v_[i].across, v_[j].across);
                positive_[i][j] = side_[i][j] != 0 ? side_[i][j] > 0
                                                   : zeroSideIsPositive(v_[i].across, v_[j].across, points[order_[i]],
                                                                        points[order_[j]]);
            }
        }
        return true;
    }

    /// The face opposite to the corner at `place`: its point and scalar there are convex combinations of the corners',
    /// from differences: exact where all three are the same.
    std::optional<Crossing> crossFace(std::size_t place) const {
        const std::size_t a = place == 0 ? 1 : 0, b = place <= 1 ? 2 : 1, c = place == 3 ? 2 : 3;
        const bool positive = positive_[b][c];
        if (positive == positive_[a][c] || positive != positive_[a][b]) return std::nullopt;
        const double wb = -side_[a][c], wc = side_[a][b], sum = side_[b][c] + wb + wc;
        if (sum == 0) return std::nullopt;
        const TriangleCrossing at{wb / sum, wc / sum, positive};
        // across × other = direction, so a face that shows its outside to the eye has a negative area
        const bool turned = (place % 2 == 1) != odd_;  // mesh::faceVertices lists it the other way round
        return Crossing{at.blend(v_[a].t, v_[b].t, v_[c].t), at.blend(s_[a], s_[b], s_[c]), positive == turned};
    }

private:
    std::array<std::size_t, 4> order_;
    bool odd_ = false;
    std::array<RayPoint, 4> v_;
    std::array<double, 4> s_;
    double side_[4][4];
    bool positive_[4][4];
};

/// Cuts the ray by one cell.
inline std::optional<RaySegment> cut(const RayFrame& ray, const mesh::ScalarMesh& mesh, mesh::CellIndex cell) {
    SeenCell seen;
    if (!seen.see(ray, mesh, cell)) return std::nullopt;
    RaySegment segment{0, 0, 0, 0, cell};
    bool entered = false, left = false;
    for (std::size_t place = 0; place < 4; ++place) {
        const auto crossing = seen.crossFace(place);
        if (!crossing) continue;
        if (crossing->enters) {
            segment.tIn = crossing->t;
            segment.scalarIn = crossing->scalar;
            entered = true;
        } else {
            segment.tOut = crossing->t;
            segment.scalarOut = crossing->scalar;
            left = true;
        }
    }
    if (!entered || !left || !(segment.tOut > segment.tIn) || !(segment.tOut > 0)) return std::nullopt;
    if (segment.tIn < 0) {  // the ray starts inside
        segment.scalarIn =
            scalarBetween(segment.scalarIn, segment.scalarOut, -segment.tIn / (segment.tOut - segment.tIn));
        segment.tIn = 0;
    }
    return segment;
}

}  // namespace tetralux::projection
