// SPDX-License-Identifier: Apache-2.0
/// \file
/// Anisotropy as a field of the data set: it does not depend on the transfer function, so it is computed once and kept.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <mesh/tet/tet_mesh.h>
#include <shading/anisotropy.h>

namespace tetralux::shading {

/// Tensors as a point field of six components (xx, yy, zz, xy, xz, yz), named after what they were computed with:
/// "anisotropy(radius=4,interval=0.05,samples=4,smoothing=0) of density". `scalar` is the scalar's name, with
/// component.
mesh::Field tensorField(const std::vector<Tensor>& tensors, const AnisotropySettings& settings,
                        const std::string& scalar);

/// The tensors of `scalar` among `fields`: those with the parameters of `settings`, or, where these are all the usual
/// ones, any. \throws std::runtime_error if a number of theirs is not finite
std::optional<std::vector<Tensor>> keptTensors(const std::vector<mesh::Field>& fields,
                                               const AnisotropySettings& settings, const std::string& scalar);

}  // namespace tetralux::shading
