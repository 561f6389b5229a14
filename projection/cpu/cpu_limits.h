// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <projection/core/pixel_maps.h>
#include <projection/cpu/cpu_tile.h>

namespace tetralux::projection {

/// Pixel maps in the terms of a frame's tiles: distances as inverse depth (TileFrame::depthReference), normals in the
/// camera's axes. `camera` is the frame's.
TileLimits tileLimits(const PixelMaps& maps, const CameraFrame& camera, const TileFrame& frame,
                      const SceneUnits& units);

}  // namespace tetralux::projection
