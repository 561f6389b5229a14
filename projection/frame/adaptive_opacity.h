// SPDX-License-Identifier: Apache-2.0
/// \file
/// Locally adaptive opacity after Marchesin, Dischler & Mongenet, "Feature Enhancement using Locally Adaptive Volume
/// Rendering", Volume Graphics 2007: each pixel's extinction follows from how much there is along its ray, so that what
/// lies behind shows as much as what lies in front, and thin places are not lost.
///
/// A first pass measures per pixel what is relevant: where τ(s) ≥ threshold·τ_peak, or an isosurface stands.
///
///   cells   N = number of relevant cells (the paper's samples); opacity of one cell τ₀ = min(gain/N, τ_max), the
///   choice
///           at which the last of N samples gets the largest weight α(1 − α)^(N − 1). Extinction τ₀·τ(s)/τ_peak per
///           mean cell size h, so f = τ₀/(τ_peak·h)
///   length  X = relevant path, in diagonals of the mesh (scale-invariant: in ranges of the scalar), which does not
///   depend
///           on the mesh's resolution; extinction τ₀ = min(gain/X, τ_max) per diagonal, f = τ₀/τ_peak
///
/// N or X is smoothed over the pixels where it is not 0 (Gaussian, or measured at half or a quarter of the size and
/// interpolated bilinearly, which is also faster), and the picture is drawn with all extinction multiplied by f: exact
/// in every mode that integrates extinction, additive ones included, where the sum becomes a weighted mean.
/// Where there are isosurfaces only, cells are counted and f = τ₀/(largest depth of an isosurface).
#pragma once

#include <functional>
#include <memory>

#include <projection/core/engine.h>

namespace tetralux::projection {

using MakeEngine = std::function<std::unique_ptr<Engine>(const Scene&)>;

/// An engine that draws `scene`, whose settings have `adaptive`, in two passes by engines that `make` makes.
std::unique_ptr<Engine> makeAdaptiveEngine(const Scene& scene, const MakeEngine& make);

/// What the factors f follow from, for tests: N or X of each pixel after smoothing, and f.
struct AdaptiveScale {
    double gain, most;  ///< τ₀ = min(gain/amount, most)
    double perTau;      ///< f = τ₀·perTau
    double factorOf(double amount) const;
};
AdaptiveScale adaptiveScale(const Scene& scene);

/// Extinction 1 per scene unit where `function` (absolute) is relevant, 0 elsewhere; its isosurfaces.
preint::TransferFunction relevanceOf(const preint::TransferFunction& function, double threshold, double perUnit);

}  // namespace tetralux::projection
