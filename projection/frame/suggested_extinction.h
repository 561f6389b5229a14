// SPDX-License-Identifier: Apache-2.0
/// \file
/// A transfer function for one mesh: fractions and extinction "per extent" in the mesh's own units, and the function
/// that is taken where none is given.
#pragma once

#include <optional>

#include <glm/vec2.hpp>

#include <mesh/tet/tet_mesh.h>
#include <preint/transfer_function.h>
#include <projection/core/modes.h>

namespace tetralux::projection {

/// Colours that stand out from black at either end, and some extinction everywhere, so that the whole mesh shows.
preint::TransferFunction defaultTransferFunction();

/// What a function is resolved for.
struct FunctionUse {
    Mode mode = Mode::Standard;
    std::optional<glm::dvec2> window;  ///< from and to which scalar it is stretched; nothing: the field's range
    bool perScalar = false;            ///< extinction is per extent of the scalar in any mode
    /// The extinction is ours to choose: what shows this very mesh, where it is thin or most of it has low values too.
    bool suggested = false;
};

/// The scalars that the function covers: the window if there is one that has a width, else the field's range.
glm::dvec2 shownRange(const FunctionUse& use, const mesh::ScalarMesh& mesh);

/// `function` in absolute units (preint::resolved). What "per extent" means: the range of the scalar where opacity
/// counts per scalar, else the mean length of a line's way through the mesh's box, scaled so that a cube has its
/// diagonal; so a thin plate or a long rod is as opaque as a cube.
preint::TransferFunction resolvedFor(const preint::TransferFunction& function, const mesh::ScalarMesh& mesh,
                                     const FunctionUse& use);

}  // namespace tetralux::projection
