// SPDX-License-Identifier: Apache-2.0
/// \file
/// From what the order-free modes gather per pixel to colours.
#pragma once

#include <preint/transfer_function.h>
#include <projection/cell_setup.h>
#include <projection/image.h>
#include <projection/scene.h>

namespace tetralux::projection {

/// Value that the target of a mode is cleared to: nothing is there where it stays.
float clearValue(Mode mode);

/// Replaces what Mode::Mip (largest scalar in red, scene units) or Mode::Average (∫s dl in red, path length in green)
/// gathered by the colour of `function` (absolute units). Other modes: nothing to do. On the processor in double:
/// the function is evaluated exactly, and one pass over the pixels is a small part of a frame.
void resolveOrderFree(Image& image, Mode mode, const preint::TransferFunction& function, const SceneUnits& units);

}  // namespace tetralux::projection
