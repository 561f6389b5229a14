// SPDX-License-Identifier: Apache-2.0
/// \file
/// A transfer function cut at its nodes, for shaders that walk along it (gl_walk.glsl) where a table misses its error.
#pragma once

#include <vector>

#include <glm/vec4.hpp>

#include <preint/preintegration_table.h>
#include <preint/transfer_function.h>

namespace tetralux::projection {

struct WalkedPieces {
    /// Three rows of one texel per piece: (low, high, extinction at low, at high), colour at low, colour at high.
    std::vector<glm::vec4> texels;
    std::vector<int> zonePiece;  ///< the first piece of each zone of the table, and how many there are

    int count() const { return zonePiece.back(); }
};

/// Whether two of the function's nodes lie between two neighbouring texels: the few segments there see none of the
/// table's kinks, and no error that was measured is theirs.
bool nodesCloserThanTexels(const preint::TransferFunction& function, const preint::PreintegrationTable& table);

/// `function` in scene units, cut also where the table's zones end. What float cannot tell apart makes no piece.
WalkedPieces walkedPieces(const preint::TransferFunction& function, const preint::PreintegrationTable& table);

}  // namespace tetralux::projection
