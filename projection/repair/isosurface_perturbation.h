// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include <projection/core/camera.h>
#include <projection/core/scene.h>

namespace tetralux::projection {

/// Pixels from the centre of a pixel to a line that is met exactly, as those of symmetric scenes are: by chance hardly
/// any is.
inline constexpr double exactDistance = 1e-7;

/// Pixels (y·width + x, in no order, some twice) whose centre an isosurface's line within a face, of which an outline
/// may be there, passes so closely that a sample EdgeOnPlanes::widest beside it may lie on the other side.
std::vector<std::uint32_t> perturbedPixels(const Scene& scene, const CameraFrame& frame);

/// Likewise pixels whose centre an edge of a cell that shows passes, or the line in which a clip plane cuts one of its
/// faces: where a ray runs along edges, which of their cells it meets first is for rounding to say. Empty where a
/// sample of the cells says that the view is none of those, as along the axes of grids, in which many edges pass
/// exactly through pixel centres.
std::vector<std::uint32_t> perturbedEdgePixels(const Scene& scene, const CameraFrame& frame);

}  // namespace tetralux::projection
