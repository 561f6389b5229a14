// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <mesh/tet/tet_mesh.h>
#include <projection/core/camera.h>

namespace tetralux::projection {

/// Pixels from the image of a face that is seen edge-on within which float planes of its two cells do not agree on which
/// side a ray passes: both would claim it, or neither. What a face is high at most to count as edge-on.
inline constexpr double edgeOnDistance = 0x1p-13;

/// Pixels (y·width + x, in no order, some twice) whose ray runs that near to a face of one of `cells` that is seen
/// edge-on. `samplesBeside`: samples stand EdgeOnPlanes::widely beside the centres, on the side on which those of the
/// reference do, so that floats tell it for faces upon which centres lie exactly, unless these are very long.
std::vector<std::uint32_t> edgeOnPixels(const mesh::ScalarMesh& mesh, const CameraFrame& frame,
                                        std::span<const mesh::CellIndex> cells, bool samplesBeside);

/// The cells of the mesh that may have such a face, and a few more: for engines that do not find them by themselves.
std::vector<mesh::CellIndex> cellsSeenEdgeOn(const mesh::ScalarMesh& mesh, const CameraFrame& frame);

}  // namespace tetralux::projection
