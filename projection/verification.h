// SPDX-License-Identifier: Apache-2.0
/// \file
/// How exact a picture is, measured: some of its pixels are computed again by the reference.
#pragma once

#include <cstddef>
#include <cstdint>

#include <projection/camera.h>
#include <projection/image.h>
#include <projection/scene.h>

namespace tetralux::projection {

/// Differences in linear premultiplied RGBA, over all four channels.
struct Verification {
    std::size_t pixels = 0;  ///< how many were computed again
    double rmse = 0.0;       ///< estimate for the whole image
    /// 95 % upper confidence bound of rmse: normal approximation of the mean of squared errors, for sampling without
    /// replacement.
    double rmseBound = 0.0;
    double max = 0.0;  ///< largest difference found
    /// With 95 % confidence at most this share of all pixels differs by more than `max` (rule of three).
    double unseenShare = 0.0;
};

/// Compares `image`, made of `scene` in `view` (with the maps it was drawn with) without background, with the reference
/// in `samples` different pixels chosen at random from `seed`; in all pixels when there are no more than that. \throws
/// std::runtime_error when the image does not have the camera's size.
Verification verifyImage(const Image& image, const Scene& scene, const View& view, std::size_t samples,
                         std::uint32_t seed);

}  // namespace tetralux::projection
