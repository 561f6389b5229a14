// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include <projection/core/camera.h>
#include <projection/core/scene.h>

namespace tetralux::projection {

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
