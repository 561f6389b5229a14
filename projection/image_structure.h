// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <projection/image.h>

namespace tetralux::projection {

/// How much structure a picture shows: 0 for a uniform one, larger the more edges and texture stand out in it, at most
/// 1/√3. After the multi-scale Haar wavelet structure detection by which Tao et al. (2009) rate views of volumes and
/// Ament and Dachsbacher (2015) compare shadings; the papers leave normalisations open, so numbers compare among
/// themselves only. As computed here, of the luminance Y = 0.2126 R + 0.7152 G + 0.0722 B over black:
///
///     A₀ = Y;  with s = 2^(i − 1) and the four values a b / c d of A_{i−1} at (x, y), (x + s, y) / (x, y + s), (x + s,
///     y + s): A_i = (a + b + c + d)/4,  H = (a − b + c − d)/4,  V = (a + b − c − d)/4,  D = (a − b − c + d)/4 E_i =
///     √(H² + V² + D²);  score = mean over the scales i = 1, 2, 3 of the mean of E_i over the picture
///
/// The transform is not decimated, so that the score does not depend on where edges fall on a grid of blocks. A picture
/// of less than 8×8 pixels uses the scales that fit; one of one row or column has the score 0.
double structureScore(const Image& image);

}  // namespace tetralux::projection
