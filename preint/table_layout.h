// SPDX-License-Identifier: Apache-2.0
/// \file
/// Which zones and interfaces a table has: jumps of the transfer function within the field's range part zones.
#pragma once

#include <vector>

#include <preint/preintegration_table.h>

namespace tetralux::preint {

/// Fills `zones` and `interfaces` of `table`. Every jump in (scalarMin, scalarMax) ends a zone; isosurfaces in (scalarMin, scalarMax]
/// become interfaces, the others can never be crossed.
/// \throws std::runtime_error when the range is not finite or reversed.
void layOutTable(const ExactIntegral& exact, double scalarMin, double scalarMax, PreintegrationTable& table);

}  // namespace tetralux::preint
