// SPDX-License-Identifier: Apache-2.0
/// \file
/// From what the order-free modes gather per pixel to colours.
#pragma once

#include <preint/transfer_function.h>
#include <projection/cells/cell_setup.h>
#include <projection/core/camera.h>
#include <projection/core/scene.h>
#include <projection/core/transfer_support.h>
#include <projection/image/image.h>

namespace tetralux::projection {

/// What the numbers that a frame gathers stand for.
struct GlGathered {
    Mode mode;
    DepthRange depths;              ///< of the camera
    double depthReference, length;  ///< scene lengths; mesh units per scene length
    bool sums;                      ///< light that adds up keeps an alpha above 1 (ContributionWeights::sums)
};

/// Value that the target of a mode is cleared to: nothing is there where it stays.
float clearValue(Mode mode);

/// Replaces what the order-free modes and Mode::Depth gathered per pixel (extreme scalar in red; ∫s dl in red and path
/// length in green; light and depth; depth in red; distance beyond depthReference in red; scene units) by the picture.
/// Returns the pixels of which rounding of the scalar may show. Other modes: nothing to do. On the processor in double:
/// the transfer function is evaluated exactly, and one pass over the pixels is a small part of a frame.
std::vector<std::uint32_t> resolveOrderFree(Image& image, const GlGathered& gathered, const ScalarColors& colors);

}  // namespace tetralux::projection
