// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <preint/transfer_function.h>

namespace tetralux::preint {

/// The middles of `count` equal steps from low to high.
std::vector<double> equidistantValues(int count, double low, double high);

/// `count` isosurfaces at the middles of equal steps Δs over [scalarMin, scalarMax] in place of the extinction of
/// `function` (absolute, τ per unit of the scalar): at v the opacity 1 − exp(−τ(v)·Δs) and the colour c(v). Crossing
/// all of them is crossing the same optical depth as in the scale-invariant integral ∫ τ |ds|, whose picture they
/// approach as 1/count (Kraus 2005, Figure 3). Isosurfaces that `function` has stay.
TransferFunction equidistantIsosurfaces(const TransferFunction& function, int count, double scalarMin,
                                        double scalarMax);

}  // namespace tetralux::preint
