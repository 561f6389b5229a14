// SPDX-License-Identifier: Apache-2.0
/// \file
/// Which zones and discontinuities a table has: jumps of the transfer function within the field's range part zones.
#pragma once

#include <vector>

#include <preint/preintegration_table.h>

namespace tetralux::preint {

/// The scalars inside each zone that deserve a texel of their own, ascending.
using ZoneKinks = std::vector<std::vector<double>>;

/// Whether segments are cut at kinks as they are at jumps: a hundred times more accurate at the same size, but each cut
/// costs a look-up. Ignored: there are no ramps, and texels are to be placed without regard to kinks.
enum class KinkCuts { None, All, Ignored };

/// Fills `zones`, `discontinuities` and `ramps` of `table` and returns the strongest kinks. Every jump in (scalarMin,
/// scalarMax), and every kink if asked for, ends a zone; isosurfaces in (scalarMin, scalarMax] become discontinuities,
/// the others can never be crossed. \throws std::runtime_error when the range is not finite or reversed.
ZoneKinks layOutTable(const ExactIntegral& exact, double scalarMin, double scalarMax, KinkCuts cuts,
                      PreintegrationTable& table);

/// Fills `texelScalars`, `warp` and `warped` for the table's size: half of the texels by width, half evenly over the
/// pieces between kinks, every kink at a texel centre. Kinks for which there is no room are left out.
void placeTexels(const ZoneKinks& kinks, PreintegrationTable& table);

}  // namespace tetralux::preint
