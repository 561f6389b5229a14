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
    std::size_t pixels = 0;     ///< how many were computed again
    std::size_t allPixels = 0;  ///< how many there are
    double rmse = 0.0;          ///< of the pixels seen
    double max = 0.0;           ///< largest difference seen
    /// With 95 % confidence no more pixels of those not seen differ by more than `max` (hypergeometric: where one more
    /// did, 19 samples of 20 would have met one; about 3/pixels of all, 0 once 95 % are seen).
    std::size_t unseenWorse = 0;
    /// What a channel of these may differ by: 1, or the picture's largest value where that is more.
    double largest = 1.0;
    /// 95 % bound of the whole picture's rmse, whatever the distribution of errors: `unseenWorse` pixels differ by
    /// `largest`, the other ones not seen by `max`.
    double rmseBound = 0.0;

    std::size_t unseen() const { return allPixels - pixels; }
    double unseenShare() const;  ///< unseenWorse of all
};

/// How many of `allPixels` have to be computed again, and found right, for a bound of the rmse within `maxError`.
std::size_t pixelsToVouchFor(double maxError, std::size_t allPixels, double largest = 1.0);

/// Compares `image`, made of `scene` in `view` (with the maps it was drawn with, FrameReport::maps) without background,
/// with the reference in `samples` different pixels chosen at random from `seed`; in all pixels when there are no more
/// than that. \throws std::runtime_error when the image does not have the camera's size.
Verification verifyImage(const Image& image, const Scene& scene, const View& view, std::size_t samples,
                         std::uint32_t seed);

}  // namespace tetralux::projection
