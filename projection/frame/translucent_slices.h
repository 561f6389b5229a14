// SPDX-License-Identifier: Apache-2.0
/// \file
/// Slices that let part of the volume behind them through: C ← C + T·a·c, T ← T·(1 − a) where a ray meets one, as at an
/// isosurface. The volume is drawn in parts, from one slice to the next, and the parts are composed.
#pragma once

#include <memory>

#include <projection/core/engine.h>

namespace tetralux::projection {

/// An engine that honours PixelMaps::translucent, by frames of `engine`: one more than the most translucent fragments
/// of a pixel.
std::unique_ptr<Engine> withTranslucentSlices(std::unique_ptr<Engine> engine);

}  // namespace tetralux::projection
