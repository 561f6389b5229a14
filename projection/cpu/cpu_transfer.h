// SPDX-License-Identifier: Apache-2.0
/// \file
/// A transfer function cut at its nodes: what the tile engine walks through instead of looking up a table.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

#include <preint/exact_integral.h>
#include <projection/cells/cell_setup.h>

namespace tetralux::projection {

/// Scalars low ≤ s < high (scene units) on which colour and extinction are linear, given about `origin`: the end at
/// which extinction is less.
struct TransferPiece {
    float low, high, origin;
    float extinction, extinctionSlope;  ///< per scene length, or per unit of scalar (scale-invariant)
    float color[3], colorSlope[3];
    bool visible;  ///< has extinction
    bool fine;     ///< the colour changes so little that V need not be known well (cpu_piece.glsl)
    std::uint32_t isosurfaceBegin, isosurfaceEnd;  ///< isosurfaces at `high`
};

struct TransferIsosurface {
    float value, opacity, depth;  ///< depth = −ln(1 − opacity), at most 1e4
    float color[3];
};

/// Colour and extinction where a function of scene units has a node.
struct TransferNode {
    double scalar, value[4];  ///< r, g, b, extinction
    bool ends;                ///< a jump or an isosurface: no piece runs through it
};

class CpuTransfer {
public:
    /// `function` in scene units (inSceneUnits). Nodes that a line meets within `tolerance` (of a colour's channel, and
    /// relative to the extinction) make one piece of the line that has the same mean there, so that errors have no
    /// sign.
    explicit CpuTransfer(const preint::TransferFunction& function, double tolerance = 0.0);

    const std::vector<TransferPiece>& pieces() const { return pieces_; }
    const std::vector<TransferIsosurface>& isosurfaces() const { return isosurfaces_; }

    /// The piece with low ≤ s < high, or low < s ≤ high.
    std::size_t pieceFromAbove(float s) const {
        const float position = std::clamp(s, 0.0f, 1.0f) * static_cast<float>(lookUpSteps);
        std::size_t piece = firstPiece_[static_cast<std::size_t>(position)];
        while (ends_[piece + 1] <= s) ++piece;
        while (ends_[piece] > s) --piece;
        return piece;
    }
    std::size_t pieceFromBelow(float s) const {
        std::size_t piece = pieceFromAbove(s);
        while (piece > 0 && ends_[piece] >= s) --piece;
        return piece;
    }

    /// Whether all that can be seen has one colour, so that order does not matter.
    bool constantColor() const { return constantColor_; }
    glm::dvec3 color() const { return color_; }

private:
    static constexpr std::size_t lookUpSteps = 1024;

    void addPiece(const preint::TransferFunction& function, double low, double high);
    void addRun(const std::vector<TransferNode>& nodes, std::size_t begin, std::size_t end);

    preint::TransferFunction function_;
    std::vector<TransferPiece> pieces_;
    std::vector<TransferIsosurface> isosurfaces_;
    std::vector<float> ends_;                // −∞, where each piece but the first begins, ∞
    std::vector<std::uint32_t> firstPiece_;  // by equal steps over [0, 1]
    bool constantColor_ = false;
    glm::dvec3 color_{0};
};

}  // namespace tetralux::projection
