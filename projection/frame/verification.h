// SPDX-License-Identifier: Apache-2.0
/// \file
/// How exact a picture is, measured: some of its pixels are computed again by the reference.
#pragma once

#include <cstddef>
#include <cstdint>

#include <projection/core/camera.h>
#include <projection/core/scene.h>
#include <projection/image/image.h>

namespace tetralux::projection {

/// Differences in linear premultiplied RGBA, over all four channels.
struct Verification {
    std::size_t pixels = 0;  ///< how many were computed again
    double rmse = 0.0;       ///< estimate for the whole image
    /// 95 % upper confidence bound of rmse. Errors of pictures have long tails, of which a sample may miss the end: the
    /// normal bound of the mean of squared errors holds in 56 to 92 of 100 samples only. So three pixels in as many as
    /// were sampled (the rule of three) are taken to be three times as wrong as the worst that was seen. That held in
    /// 96 of 100 samples of 1000 pixels and more, on smooth pictures, isosurfaces, first hits and cells in a wrong
    /// order. A single wrong pixel that no sample meets is not in it: `unseenShare` says how many there may be.
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
