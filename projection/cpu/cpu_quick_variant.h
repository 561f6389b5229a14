// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <projection/cpu/cpu_tile.h>
#include <shading/lights.h>

namespace tetralux::projection {

/// Whether nothing but silhouettes (Kraus 2005, Equation 15) is asked for, or not even these.
bool silhouettesAtMost(const shading::ShadingSettings& settings);

/// The kernel that draws such silhouettes and lights, and what it needs. `frame`: with its axes and lights.
QuickVariant quickVariant(const shading::ShadingSettings& shading, const TileFrame& frame);

}  // namespace tetralux::projection
