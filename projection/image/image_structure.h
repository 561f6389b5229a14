// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <projection/image/image.h>

namespace tetralux::projection {

/// How much structure `lit` shows that `unlit`, the same picture without light, does not: 0 where they agree up to
/// brightness, at most 1. After the multi-scale homogeneity-weighted structural dissimilarity by which Tao et al.
/// ("Structure-Aware Lighting Design for Volume Visualization", IEEE TVCG 18(12), 2012) rate lights and Ament and
/// Dachsbacher (2015) compare shadings. Their constants are not published in full, so numbers compare among themselves
/// only. As computed here, of the luminance Y = 0.2126 R + 0.7152 G + 0.0722 B over black, clamped to [0, 1]:
///
///     per window of 8×8 pixels   d = 1 − (2σ_ab + C)/(σ_a² + σ_b² + C),  h = C/(σ_a² + C),  C = 0.1²
///     score = mean over the scales i = 0 … 3, each of half the pixels per side of the one before (means of 2×2), of
///             the mean of h·d over all windows
///
/// d is what Wang et al. (2004) call contrast and structure in their similarity index, σ are standard deviations, σ_ab
/// the covariance of unlit a and lit b: light that only makes a window brighter does not count. h is 1 where the unlit
/// picture is homogeneous: it is there that light can tell of a shape what colours do not. Windows are taken at every
/// pixel. Scales of less than 8×8 pixels are left out; a picture too small for any has the score 0.
/// \throws std::runtime_error if the pictures differ in size
double structureScore(const Image& unlit, const Image& lit);

/// How much structure a picture shows by itself: the score against a uniform one.
double structureScore(const Image& image);

}  // namespace tetralux::projection
