// SPDX-License-Identifier: Apache-2.0
/// \file
/// The kernels of plain pictures (cpu_tile_drawing.h), and which one a frame takes.
#include <projection/cpu/cpu_targets.h>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "projection/cpu/cpu_tile_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <projection/cpu/cpu_tile_drawing.h>

HWY_BEFORE_NAMESPACE();
namespace tetralux::projection::HWY_NAMESPACE {

template <bool Orthographic, bool ScaleInvariant, Look look>
void drawLookedTile(const TileFrame& frame, int x0, int y0, std::span<const TileEntry> entries, Image& image,
                    TileResult& result) {
    if constexpr (look == Look::General)
        drawTileAs<TileKind::Shaded, Orthographic, ScaleInvariant, true>(frame, x0, y0, entries, image, result);
    else if (frame.transfer->peaks().empty())
        drawTileAs<TileKind::Composite, Orthographic, ScaleInvariant, false, false, look>(frame, x0, y0, entries, image,
                                                                                          result);
    else
        drawTileAs<TileKind::Composite, Orthographic, ScaleInvariant, true, false, look>(frame, x0, y0, entries, image,
                                                                                         result);
}

template <bool Orthographic, bool ScaleInvariant>
void drawShadedTile(const TileFrame& frame, int x0, int y0, std::span<const TileEntry> entries, Image& image,
                    TileResult& result) {
    switch (frame.look.look) {
        case Look::General:
            return drawLookedTile<Orthographic, ScaleInvariant, Look::General>(frame, x0, y0, entries, image, result);
        case Look::Silhouettes:
            return drawLookedTile<Orthographic, ScaleInvariant, Look::Silhouettes>(frame, x0, y0, entries, image,
                                                                                   result);
        case Look::Lit:
            return drawLookedTile<Orthographic, ScaleInvariant, Look::Lit>(frame, x0, y0, entries, image, result);
        case Look::Lamps:
            return drawLookedTile<Orthographic, ScaleInvariant, Look::Lamps>(frame, x0, y0, entries, image, result);
    }
}

template <bool Orthographic, bool ScaleInvariant>
void drawAbsorbingTile(const TileFrame& frame, int x0, int y0, std::span<const TileEntry> entries, Image& image,
                       TileResult& result) {
    if (frame.look.silhouettes)
        drawTileAs<TileKind::Absorption, Orthographic, ScaleInvariant, true, false, Look::Silhouettes>(
            frame, x0, y0, entries, image, result);
    else
        drawTileAs<TileKind::Absorption, Orthographic, ScaleInvariant, true>(frame, x0, y0, entries, image, result);
}

template <bool Orthographic>
void drawTileIn(const TileFrame& frame, int x0, int y0, std::span<const TileEntry> entries, Image& image,
                TileResult& result) {
    const bool peaks = !frame.transfer->peaks().empty();
    switch (frame.kind) {
        case TileKind::Mip:
            return drawTileAs<TileKind::Mip, Orthographic, false, false>(frame, x0, y0, entries, image, result);
        case TileKind::Minimum:
            return drawTileAs<TileKind::Minimum, Orthographic, false, false>(frame, x0, y0, entries, image, result);
        case TileKind::Average:
            return drawTileAs<TileKind::Average, Orthographic, false, false>(frame, x0, y0, entries, image, result);
        case TileKind::Absorption:
            if (frame.scaleInvariant)
                return drawAbsorbingTile<Orthographic, true>(frame, x0, y0, entries, image, result);
            return drawAbsorbingTile<Orthographic, false>(frame, x0, y0, entries, image, result);
        case TileKind::Composite:
            if (frame.scaleInvariant)
                return peaks ? drawTileAs<TileKind::Composite, Orthographic, true, true>(frame, x0, y0, entries, image,
                                                                                         result)
                             : drawTileAs<TileKind::Composite, Orthographic, true, false>(frame, x0, y0, entries, image,
                                                                                          result);
            return peaks ? drawTileAs<TileKind::Composite, Orthographic, false, true>(frame, x0, y0, entries, image,
                                                                                      result)
                         : drawTileAs<TileKind::Composite, Orthographic, false, false>(frame, x0, y0, entries, image,
                                                                                       result);
        case TileKind::Shaded:
            if (frame.scaleInvariant) return drawShadedTile<Orthographic, true>(frame, x0, y0, entries, image, result);
            return drawShadedTile<Orthographic, false>(frame, x0, y0, entries, image, result);
        case TileKind::FirstHit:
            return drawTileAs<TileKind::FirstHit, Orthographic, false, true>(frame, x0, y0, entries, image, result);
        case TileKind::Additive:
        case TileKind::Depth:
            break;  // drawLimitedTile
    }
}

void drawTileHere(const TileFrame& frame, int x0, int y0, std::span<const TileEntry> entries, Image& image,
                  TileResult& result) {
    if (frame.orthographic)
        drawTileIn<true>(frame, x0, y0, entries, image, result);
    else
        drawTileIn<false>(frame, x0, y0, entries, image, result);
}

const char* instructionSet() {
    return hwy::TargetName(HWY_TARGET);
}

}  // namespace tetralux::projection::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tetralux::projection {

HWY_EXPORT(drawTileHere);
HWY_EXPORT(instructionSet);

void drawTile(const TileFrame& frame, int x0, int y0, std::span<const TileEntry> entries, Image& image,
              TileResult& result) {
    HWY_DYNAMIC_DISPATCH(drawTileHere)(frame, x0, y0, entries, image, result);
}

const char* tileInstructionSet() {
    return HWY_DYNAMIC_DISPATCH(instructionSet)();
}

}  // namespace tetralux::projection
#endif
