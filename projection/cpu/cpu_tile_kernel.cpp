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

template <TileKind Kind, ShadingVariant variant, bool ScaleInvariant>
void drawTileOf(const TileFrame& frame, int x0, int y0, std::span<const TileEntry> entries, Image& image,
                TileResult& result) {
    constexpr bool depthOnly = Kind == TileKind::Absorption;  // quick enough where isosurfaces are looked for in vain
    if (depthOnly || !frame.transfer->isosurfaces().empty())
        drawTileAs<Kind, ScaleInvariant, true, false, variant>(frame, x0, y0, entries, image, result);
    else
        drawTileAs<Kind, ScaleInvariant, depthOnly, false, variant>(frame, x0, y0, entries, image, result);
}

template <TileKind Kind, ShadingVariant variant>
void drawVariantTile(const TileFrame& frame, int x0, int y0, std::span<const TileEntry> entries, Image& image,
                     TileResult& result) {
    if (frame.scaleInvariant)
        drawTileOf<Kind, variant, true>(frame, x0, y0, entries, image, result);
    else
        drawTileOf<Kind, variant, false>(frame, x0, y0, entries, image, result);
}

void drawTileHere(const TileFrame& frame, int x0, int y0, std::span<const TileEntry> entries, Image& image,
                  TileResult& result) {
    if (frame.kind == TileKind::Absorption) {
        if (frame.variant.silhouettes)
            return drawVariantTile<TileKind::Absorption, ShadingVariant::Silhouettes>(frame, x0, y0, entries, image,
                                                                                      result);
        return drawVariantTile<TileKind::Absorption, ShadingVariant::General>(frame, x0, y0, entries, image, result);
    }
    if (frame.kind == TileKind::FirstHit)
        return drawTileAs<TileKind::FirstHit, false, true>(frame, x0, y0, entries, image, result);
    if (frame.kind == TileKind::Composite)
        return drawVariantTile<TileKind::Composite, ShadingVariant::General>(frame, x0, y0, entries, image, result);
    switch (frame.variant.variant) {
        case ShadingVariant::Silhouettes:
            return drawVariantTile<TileKind::Composite, ShadingVariant::Silhouettes>(frame, x0, y0, entries, image,
                                                                                     result);
        case ShadingVariant::Lit:
            return drawVariantTile<TileKind::Composite, ShadingVariant::Lit>(frame, x0, y0, entries, image, result);
        case ShadingVariant::LocalLights:
            return drawVariantTile<TileKind::Composite, ShadingVariant::LocalLights>(frame, x0, y0, entries, image,
                                                                                     result);
        case ShadingVariant::General:
            if (frame.scaleInvariant)
                drawTileAs<TileKind::Shaded, true, true>(frame, x0, y0, entries, image, result);
            else
                drawTileAs<TileKind::Shaded, false, true>(frame, x0, y0, entries, image, result);
    }
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
