// SPDX-License-Identifier: Apache-2.0
/// \file
/// What a picture shows of the scalars along a ray.
#pragma once

#include <algorithm>

#include <mesh/tet/tet_mesh.h>
#include <preint/exact_integral.h>
#include <projection/core/camera.h>

namespace tetralux::projection {

enum class Mode {
    Standard,
    ScaleInvariant,
    Mip,      ///< the largest scalar along the ray, coloured by c
    Minimum,  ///< the smallest one
    Average,  ///< the length-weighted mean of the scalar, coloured by c
    Additive,  ///< C = ∫ c τ dt, a peak adds α₀·colour; nothing hides anything. Alpha = min(1, ∫ τ dt + Σ α₀): how much
               ///< of the background goes. Colours may exceed 1
    DataAdditive,  ///< Additive with |ds| in dt's place: what counts is how much the scalar varies
    Emission,      ///< the same light with alpha 0 (Max 1995, "emission only"): it is added to the background
    Absorption,  ///< black, alpha = 1 − exp(−∫ τ dt) (Max 1995, "absorption only"): a radiograph over its background
    FirstHit,  ///< the colour of the first segment with α > 0, opaque
    Depth,     ///< grey, opaque: 1 at the nearest, 0 at the farthest end of the mesh's bounding sphere (depthRange),
               ///< linear in the distance along the ray to the first point with τ > 0 or an isosurface
    Contribution,  ///< for adaptive opacity: red counts the cells with τ > 0 or a peak on the ray, green is ∫ τ dt
    DataContribution  ///< the same with ∫ τ |ds|
};

/// The integral that a mode's segments use: the scale-invariant one in ScaleInvariant, DataAdditive and
/// DataContribution.
preint::Integral integralOf(Mode mode);

/// Whether the light of segments adds up, hidden by nothing.
bool addsUp(Mode mode);

/// Whether the order of the cells along a ray does not matter.
bool orderFree(Mode mode);

/// Whether a mode composes what lies behind under what is in front, part by part.
bool composesParts(Mode mode);

/// Distances along rays that Mode::Depth shows as 1 and 0: eye (orthographic: its plane) to the ends of the sphere
/// about the mesh's bounding box, at least 0.
struct DepthRange {
    double nearest, farthest;
    double greyAt(double distance) const { return (farthest - distance) / (farthest - nearest); }
    double greyPerDistance() const { return -1.0 / (farthest - nearest); }
    /// 0 at the nearest, 1 at the farthest end, within that.
    double shareAt(double distance) const { return std::clamp(1.0 - greyAt(distance), 0.0, 1.0); }
};
DepthRange depthRange(const mesh::BoundingBox& bounds, const Camera& camera);

/// What a segment from s_f to s_b with path P (its length, or |s_b − s_f| in the scale-invariant integral) shows.
enum class Classification {
    Preintegrated,  ///< the integral itself
    Post,           ///< Kraus 2005, Eq. 10: α = 1 − exp(−τ(s_m)·P), colour c(s_m), s_m = (s_f + s_b)/2; no peaks
    PostLinear,     ///< Eq. 11, the linear form: α = min(1, τ(s_m)·P)
    Pre             ///< τ and c at the vertices, interpolated to the segment's middle, instead of those of s_m
};

/// Locally adaptive opacity: adaptive_opacity.h tells what each of these is.
struct AdaptiveSettings {
    enum class Amount { Cells, Length };
    enum class Filter { None, Gaussian, Bilinear2, Bilinear4 };
    Amount amount = Amount::Length;
    Filter filter = Filter::Gaussian;
    double sigma = 4.0;              ///< of the Gaussian, pixels
    double gain = 1.0;               ///< τ₀ = gain/amount
    double most = 10.0;              ///< τ_max: per diagonal (or range); of one cell with Amount::Cells
    double threshold = 1.0 / 256.0;  ///< share of the largest extinction from which on scalars are relevant
};

}  // namespace tetralux::projection
