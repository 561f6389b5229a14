// SPDX-License-Identifier: Apache-2.0
/// \file
/// From what the order-free modes gather per pixel to colours.
#pragma once

#include <preint/transfer_function.h>
#include <projection/cells/cell_setup.h>
#include <projection/core/camera.h>
#include <projection/core/scene.h>
#include <projection/image/image.h>

namespace tetralux::projection {

/// Value that the target of a mode is cleared to: nothing is there where it stays.
float clearValue(Mode mode);

/// Replaces what the order-free modes and Mode::Depth gathered per pixel (extreme scalar in red; ∫s dl in red and path
/// length in green; light and depth; depth in red; distance in red; scene units) by the picture. Other modes: nothing
/// to do. On the processor in double: the transfer function is evaluated exactly, and one pass over the pixels is a
/// small part of a frame.
void resolveOrderFree(Image& image, const Scene& scene, const Camera& camera, const SceneUnits& units);

}  // namespace tetralux::projection
