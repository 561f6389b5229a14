// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <vector>

#include <projection/core/pixel_maps.h>
#include <projection/core/scene.h>
#include <projection/image/image.h>

namespace tetralux::projection {

/// N(x, y): alpha of what `measure` gives for a view, smoothed as the settings say and interpolated to the view's
/// pixels. Values of 0 (nothing there) take no part in the smoothing, and stay 0 where all around is 0.
std::vector<float> contributionMap(const View& view, const AdaptiveSettings& settings,
                                   const std::function<Image(const View&)>& measure);

}  // namespace tetralux::projection
