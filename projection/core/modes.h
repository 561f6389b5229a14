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
    Additive,  ///< C = ∫ c τ dt, an isosurface adds α₀·colour; nothing hides anything. Alpha = min(1, ∫ τ dt + Σ α₀):
               ///< how much of the background goes. Colours may exceed 1
    DataAdditive,  ///< Additive with |ds| in dt's place: what counts is how much the scalar varies
    Emission,      ///< the same light with alpha 0 (Max 1995, "emission only"): it is added to the background
    Absorption,  ///< black, alpha = 1 − exp(−∫ τ dt) (Max 1995, "absorption only"): a radiograph over its background
    FirstHit,  ///< the colour of the first segment with α > 0, opaque
    Depth,     ///< grey, opaque: 1 at the nearest, 0 at the farthest end of the mesh's bounding sphere (depthRange),
               ///< linear in the distance along the ray to the first point with τ > 0 or an isosurface
    Contributions  ///< grey: how many contributions locally adaptive opacity counts on the ray (adaptive_opacity.h),
                   ///< opaque where there are any. Engines never see it
};

/// The integral that a mode's segments use: the scale-invariant one in ScaleInvariant and DataAdditive.
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
    Post,  ///< Kraus 2005, Eq. 10 and 11: colour c(s_m), α = 1 − exp(−τ(s_m)·P), s_m = (s_f + s_b)/2; no isosurfaces
    PostLinear,  ///< the approximation at the end of Eq. 11: α = min(1, τ(s_m)·P)
    Pre          ///< τ and c at the vertices, interpolated to the segment's middle, instead of those of s_m
};

/// Locally adaptive opacity: adaptive_opacity.h tells what each of these is.
struct AdaptiveSettings {
    enum class Unit { Cells, Length };  ///< what one contribution is: a cell, or a piece of relevant length
    enum class Filter { None, Gaussian, Bilinear2, Bilinear4 };
    Unit unit = Unit::Cells;
    Filter filter = Filter::None;
    double sigma = 4.0;        ///< of the Gaussian, pixels
    double most = 0.12;        ///< τ_max
    double threshold = 0.0;    ///< share of the largest extinction above which scalars are relevant, below 1
    double pieceLength = 0.0;  ///< Δ, mesh units (units of the scalar over |ds|); 0: the mean of the mesh's edges
};

/// What adaptive opacity asks of an engine besides a transfer function; other pictures leave it alone.
struct ContributionWeights {
    /// A segment along which anything shows is one contribution whatever its length, each isosurface that it crosses
    /// another: its optical depth is their number times the pixel's factor of extinction, its colour their mean.
    bool perCell = false;
    bool sums = false;  ///< in modes that add up: alpha is ∫ τ + Σ α₀ itself, not cut off at 1

    bool any() const { return perCell || sums; }
};

}  // namespace tetralux::projection
