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

/// Pixels (y·width + x, in no order, some twice) whose centre an isosurface's line within a face passes so closely that
/// the two cells of the face, whose floats differ, may both cross it or neither, or that a sample which stands as far
/// beside the centre as EdgeOnPlanes::widest may see its outline on the other side.
std::vector<std::uint32_t> perturbedPixels(const Scene& scene, const CameraFrame& frame);

/// Likewise pixels whose centre an edge of a cell that shows passes, or the line in which a clip plane cuts one of its
/// faces: where a ray runs along edges, which of their cells it meets first is for rounding to say. Where a sample of
/// the cells says that the view is none of those, as along the axes of grids, in which many edges pass exactly through
/// pixel centres, only the pixels within rounding of an edge if cells are counted, and else none.
std::vector<std::uint32_t> perturbedEdgePixels(const Scene& scene, const CameraFrame& frame);

}  // namespace tetralux::projection
