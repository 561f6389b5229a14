// SPDX-License-Identifier: Apache-2.0
/// \file
/// The kernels for everything: limits, other classifications, modes that hide nothing (cpu_clipped_segment.h), extreme
/// and mean scalars.
#include <projection/cpu/cpu_targets.h>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "projection/cpu/cpu_clipped_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <projection/cpu/cpu_tile_drawing.h>

HWY_BEFORE_NAMESPACE();
namespace tetralux::projection::HWY_NAMESPACE {

template <TileKind Kind>
void drawClippedAs(const TileFrame& frame, int x0, int y0, std::span<const TileEntry> entries, Image& image,
                   TileResult& result) {
    drawTileAs<Kind, false, true, true>(frame, x0, y0, entries, image, result);
}

void drawClippedTileHere(const TileFrame& frame, int x0, int y0, std::span<const TileEntry> entries, Image& image,
                         TileResult& result) {
    switch (frame.kind) {
        case TileKind::Mip:
            return drawClippedAs<TileKind::Mip>(frame, x0, y0, entries, image, result);
        case TileKind::Minimum:
            return drawClippedAs<TileKind::Minimum>(frame, x0, y0, entries, image, result);
        case TileKind::Average:
            return drawClippedAs<TileKind::Average>(frame, x0, y0, entries, image, result);
        case TileKind::Absorption:
            return drawClippedAs<TileKind::Absorption>(frame, x0, y0, entries, image, result);
        case TileKind::Composite:
        case TileKind::Shaded:
            return drawClippedAs<TileKind::Shaded>(frame, x0, y0, entries, image, result);
        case TileKind::FirstHit:
            return drawClippedAs<TileKind::FirstHit>(frame, x0, y0, entries, image, result);
        case TileKind::Additive:
            return drawClippedAs<TileKind::Additive>(frame, x0, y0, entries, image, result);
        case TileKind::Depth:
            return drawClippedAs<TileKind::Depth>(frame, x0, y0, entries, image, result);
    }
}

}  // namespace tetralux::projection::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tetralux::projection {

HWY_EXPORT(drawClippedTileHere);

void drawClippedTile(const TileFrame& frame, int x0, int y0, std::span<const TileEntry> entries, Image& image,
                     TileResult& result) {
    HWY_DYNAMIC_DISPATCH(drawClippedTileHere)(frame, x0, y0, entries, image, result);
}

}  // namespace tetralux::projection
#endif
