// SPDX-License-Identifier: Apache-2.0
/// \file
/// Locally adaptive opacity after Marchesin, Dischler & Mongenet, "Feature Enhancement using Locally Adaptive Volume
/// Rendering", Volume Graphics 2007: what lies behind shows as much as what lies in front, whatever the transfer
/// function, which only tells what is relevant: δ(s) = 1 where τ(s) > threshold·τ_peak or an isosurface stands, else 0.
///
/// Along a ray N contributions are counted, each of the opacity τ̃ = min(τ_max, 1/N), at which the last of them gets the
/// largest weight (Equation 7):
///
///   cells   the cells with relevant length; each shows the mean colour of what is relevant in it (Equations 8 and 12).
///   length  pieces of relevant length Δ: N = ∫ δ dt/Δ, a real number, and a relevant length l has the opacity
///           1 − (1 − τ̃)^(l/Δ), as extinction −ln(1 − τ̃)/Δ has. Does not depend on the mesh, once Δ is given.
///
/// Each isosurface that is crossed is one contribution more. By length, scale-invariant modes count |ds|; by cells
/// both integrals show the same.
///
/// Modes that hide are drawn in two passes: N(x, y), which may be smoothed over the pixels where it is not 0 (Gaussian,
/// or measured at half or a quarter of the size and interpolated bilinearly), and the picture, whose extinction is that
/// of δ times the pixel's −ln(1 − τ̃). Modes that add up are means, C = ∫ c δ dt/∫ δ dt (Equation 13) or Σ c̄/N (12),
/// with alpha 1 where there is anything: one pass gathers both sums (Equations 14 to 17, where c̃ and δ̃ are exact), and
/// neither τ_max nor smoothing has a say.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include <projection/core/engine.h>

namespace tetralux::projection {

using MakeEngine = std::function<std::unique_ptr<Engine>(const Scene&)>;

/// Whether a picture of these settings takes makeAdaptiveEngine.
bool isAdaptive(const RenderSettings& settings);

/// An engine that draws `scene`, for which isAdaptive, by engines that `make` makes.
std::unique_ptr<Engine> makeAdaptiveEngine(const Scene& scene, const MakeEngine& make);

/// Some pixels (y·width + x, ascending) of such a scene by the reference, N too, into `image` of the view's size.
void castAdaptivePixels(const Scene& scene, const View& view, const std::vector<std::uint32_t>& pixels, Image& image);

/// The factor of extinction where N contributions were counted: −ln(1 − min(τ_max, 1/N)), finite.
double contributionDepth(double count, double most);

/// δ as extinction: `level` where `function` (absolute) is relevant, 0 elsewhere, with its colours; isosurfaces of that
/// opacity. What is not above the threshold at the foot of a ramp is not relevant there either: the step
/// stands higher by as little as double tells.
preint::TransferFunction relevanceOf(const preint::TransferFunction& function, double threshold, double level,
                                     double isosurfaceOpacity);

/// Δ where none is given: the mean length of the mesh's edges, each counted once; over |ds| the mean difference of the
/// scalar along those along which it differs.
double meanEdge(const mesh::ScalarMesh& mesh, preint::Integral integral);

}  // namespace tetralux::projection
