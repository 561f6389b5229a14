// SPDX-License-Identifier: Apache-2.0
/// \file
/// Isosurfaces lower by what rounding may amount to.
#pragma once

#include <projection/core/scene.h>

namespace tetralux::projection {

/// A ray through the pixel's centre may meet exactly the value of an isosurface where it enters the mesh or turns: on a
/// boundary face or a plateau of that value, or where an outline falls on a row of pixel centres, as it does in views
/// along the axes of grids. By definition s = v is not below v. Rounding must not decide otherwise for one pixel, or
/// one cell of two, and not for the next: so isosurfaces stand lower by what rounding may amount to, a share of the
/// range.
inline constexpr double floatPerturbation = 0x1p-21;  ///< fast engines: scalars of 0 … 1 at crossings of float planes
inline constexpr double doublePerturbation = 0x1p-33;  ///< the reference: double, and rays 2⁻³² pixel beside the centre

/// The scene with isosurfaces lower by `share` of the field's range, but for those that coincide with a jump of the
/// transfer function, which are to stay on their side of it.
Scene withPerturbedIsosurfaces(const Scene& scene, double share);

}  // namespace tetralux::projection
