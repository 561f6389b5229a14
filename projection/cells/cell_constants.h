// SPDX-License-Identifier: Apache-2.0
/// \file
/// Numbers of the texts that C++ and shaders share (projected_cell.glsl, cell_outline.glsl, covered_pixels.glsl);
/// shaders get them as definitions of these names (gl_compute.cpp).
#pragma once

namespace tetralux::projection {

/// Bounds of plane coefficients, so that what is computed from them in float stays finite.
inline constexpr double largestPlane = 1e30;
/// Least |λ(eye)| of a face: its plane stays finite when it is seen edge-on.
inline constexpr double leastEyeCoordinate = 1e-20, leastDeterminant = 1e-140;
/// Scalars (scene units) that differ by less say nothing of a gradient in float; and the least float that one becomes.
inline constexpr double leastKeptRise = 1e-20, leastFloatGradient = 2e-38;
/// Beyond every pixel that there is.
inline constexpr double unboundedPixel = 1e300;
/// Least |depth| of an orthographic view's reference point.
inline constexpr double leastDepth = 1e-9;

/// Depths below this share of the cell's largest depth count as behind the eye.
inline constexpr double nearestDepthShare = 1e-6;
/// Cells with all depths above this share of the largest are described about their centroid.
inline constexpr double centroidDepthShare = 0.1;

/// Below this, 1 + cos of the turn at a corner: the corner's miter would reach 30 margins far.
inline constexpr double sharpestCorner = 2e-3;
/// Outlines that reach farther than this beyond the image (pixels) are drawn as rectangles instead: rasterizers compute
/// in fixed point.
inline constexpr double farthestCorner = 4096.0;

/// Below this transmittance a pixel is finished, in every engine that composes front to back: colours are at most 1, so
/// that is also the largest error of a channel.
inline constexpr float leastTransmittance = 1e-6f;

}  // namespace tetralux::projection
