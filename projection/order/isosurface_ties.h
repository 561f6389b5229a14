// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include <projection/camera.h>
#include <projection/scene.h>

namespace tetralux::projection {

/// A ray through the pixel's centre may meet exactly the value of an isosurface where it enters the mesh or turns: on a
/// boundary face or a plateau of that value, or where an outline falls on a row of pixel centres, as it does in views
/// along the axes of grids. By definition s = v is not below v. Rounding must not decide otherwise for one pixel, or
/// one cell of two, and not for the next: so isosurfaces stand lower by what rounding may amount to, a share of the
/// range.
inline constexpr double floatTie = 0x1p-21;   ///< fast engines: scalars of 0 … 1 at crossings of float planes
inline constexpr double doubleTie = 0x1p-33;  ///< the reference: double, and rays 2⁻³² pixel beside the centre

/// The scene with isosurfaces lower by `share` of the field's range, but for those that coincide with a jump of the
/// transfer function, which are to stay on their side of it.
Scene withTiesAbove(const Scene& scene, double share);

/// Pixels (y·width + x, in no order, some twice) whose centre a line at which the picture may jump passes so closely
/// that a sample EdgeOnPlanes::widely beside it may lie on the other side: an isosurface's within a face, of which an
/// outline may be there, or the edge of a face that is seen edge-on, which may be the wall of a cell. Faces upon which
/// centres lie exactly are not among the latter: samples stand beside the centres on the side on which those of the
/// reference do.
std::vector<std::uint32_t> tiedPixels(const Scene& scene, const CameraFrame& frame);

/// Likewise pixels whose centre an edge of a cell that shows passes: where a ray runs along edges, which of their cells
/// it meets first is for rounding to say. Empty where a sample of the cells says that the view is none of those, as
/// along the axes of grids, in which many edges pass exactly through pixel centres.
std::vector<std::uint32_t> tiedEdgePixels(const Scene& scene, const CameraFrame& frame);

}  // namespace tetralux::projection
