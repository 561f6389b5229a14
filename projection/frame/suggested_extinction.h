// SPDX-License-Identifier: Apache-2.0
/// \file
/// A transfer function for one mesh: fractions and extinction "per extent" in the mesh's own units, and the function
/// that is taken where none is given.
#pragma once

#include <vector>

#include <glm/vec2.hpp>

#include <mesh/tet/tet_mesh.h>
#include <mesh/tet/volume_samples.h>
#include <preint/transfer_function.h>
#include <projection/core/modes.h>

namespace tetralux::projection {

/// Colours that stand out from black at either end, and some extinction everywhere, so that the whole mesh shows.
preint::TransferFunction defaultTransferFunction();

/// What a function is resolved for.
struct FunctionUse {
    Mode mode = Mode::Standard;
    bool perScalar = false;  ///< extinction is per extent of the scalar in any mode
    /// Of the mesh, for functions whose extinction is suggested; nullptr: they are taken when they are needed.
    const mesh::VolumeSamples* samples = nullptr;
};

/// The scalars that the function covers: its range if it has one with a width, else the field's.
glm::dvec2 shownRange(const preint::TransferFunction& function, const mesh::ScalarMesh& mesh);

/// The values that the field has, ascending, if there are up to 256 of them.
std::vector<double> fewValues(const mesh::ScalarMesh& mesh);

/// `function` in absolute units (preint::resolved). What "per extent" means: the range of the scalar where opacity
/// counts per scalar, else the mean length of a line's way through the mesh's box, scaled so that a cube has its
/// diagonal; so a thin plate or a long rod is as opaque as a cube. Where the function's extinction is suggested, it is
/// raised, up to eightfold, until this very mesh shows, if that is thin or mostly of low values. \throws
/// std::runtime_error as preint::resolved does.
preint::TransferFunction resolvedFor(const preint::TransferFunction& function, const mesh::ScalarMesh& mesh,
                                     const FunctionUse& use);

}  // namespace tetralux::projection
