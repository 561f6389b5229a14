// SPDX-License-Identifier: Apache-2.0
/// \file
/// Setup of eight cells at once for one tile: corners to planes, in doubles, one lane per cell. Included once per
/// instruction set.
///
/// Records are made where they are used and never stored: a cell is set up again in every tile that it meets (1.2 to 2
/// times), which costs less than writing and reading back 100 bytes per cell, and cells behind an opaque tile are never
/// set up at all.
#include <projection/cpu/cpu_simd.h>

#include <projection/cells/cell_constants.h>
#include <projection/cpu/cpu_special_cell.h>
#include <projection/cpu/cpu_tile.h>

#if defined(TETRALUX_CPU_CELL_BATCH_H) == defined(HWY_TARGET_TOGGLE)
#ifdef TETRALUX_CPU_CELL_BATCH_H
#undef TETRALUX_CPU_CELL_BATCH_H
#else
#define TETRALUX_CPU_CELL_BATCH_H
#endif

HWY_BEFORE_NAMESPACE();
namespace tetralux::projection::HWY_NAMESPACE {

#undef TETRALUX_CELL_FUNCTION
#undef TETRALUX_CELL_IN
#undef TETRALUX_CELL_INOUT
#define TETRALUX_CELL_FUNCTION HWY_INLINE
#define TETRALUX_CELL_IN(type) const type&
#define TETRALUX_CELL_INOUT(type) type&
// each stands on those before it
// clang-format off
#include <projection/cells/cell_triple.inl>
#include <projection/cells/projected_cell.glsl>
#include <projection/cells/cell_depth_bounds.inl>
// clang-format on

/// Point numbers of the batch's cells in ascending order, and whether that order turns the cell inside out.
struct SortedCorners {
    alignas(64) std::int32_t point[4][CellBatch::capacity];
    alignas(64) std::int32_t odd[CellBatch::capacity];
    alignas(64) std::int32_t cell[CellBatch::capacity];
};

/// `entries`: eight of them.
HWY_INLINE void sortCorners(const TileFrame& frame, const TileEntry* entries, SortedCorners& corners) {
    const hn::CappedTag<std::int32_t, CellBatch::capacity> tag;
    const auto* points = reinterpret_cast<const std::int32_t*>(frame.cells);
    for (std::size_t j = 0; j < CellBatch::capacity; j += hn::Lanes(tag)) {
        hn::Vec<decltype(tag)> key, cell, p[4], odd = hn::Zero(tag);
        hn::LoadInterleaved2(tag, reinterpret_cast<const std::int32_t*>(entries + j), key, cell);
        hn::Store(cell, tag, &corners.cell[j]);
        const auto row = hn::ShiftLeft<2>(cell);
        for (int k = 0; k < 4; ++k) p[k] = hn::GatherIndex(tag, points, hn::Add(row, hn::Set(tag, k)));
        auto exchange = [&](std::size_t a, std::size_t b) HWY_ATTR {
            const auto low = hn::Min(p[a], p[b]), high = hn::Max(p[a], p[b]);
            odd = hn::Xor(odd, hn::VecFromMask(tag, hn::Ne(low, p[a])));
            p[a] = low;
            p[b] = high;
        };
        exchange(0, 1);
        exchange(2, 3);
        exchange(0, 2);
        exchange(1, 3);
        exchange(1, 2);
        for (std::size_t k = 0; k < 4; ++k) hn::Store(p[k], tag, &corners.point[k][j]);
        hn::Store(odd, tag, &corners.odd[j]);
    }
}

using DoubleIndexTag = hn::RebindToSigned<DoubleTag>;
using HalfFloatTag = hn::Rebind<float, DoubleTag>;

using HalfIntTag = hn::Rebind<std::int32_t, DoubleTag>;

HWY_INLINE void storeFloats(wide value, float* to) {
    hn::StoreU(hn::DemoteTo(HalfFloatTag(), value.v), HalfFloatTag(), to);
}

/// As a float, and what that leaves.
HWY_INLINE void storeInTwo(wide value, float* to, float* rest) {
    const auto rounded = hn::DemoteTo(HalfFloatTag(), value.v);
    hn::StoreU(rounded, HalfFloatTag(), to);
    storeFloats(value - wide(hn::PromoteTo(DoubleTag(), rounded)), rest);
}

/// Cells in which a plane changes so much over the cell's image that floats, which err by 2^-24 of that, misjudge it by
/// more than 2^-11 of the cell's thickness (at the reference point).
HWY_INLINE wide_mask steepCells(const ProjectedCell& cell, const hn::Vec<DoubleTag> (&pixels)[4]) {
    const hn::Repartition<float, DoubleTag> pairs;
    const auto p0 = hn::BitCast(pairs, pixels[0]), p1 = hn::BitCast(pairs, pixels[1]),
               p2 = hn::BitCast(pairs, pixels[2]), p3 = hn::BitCast(pairs, pixels[3]);
    const auto sizes = hn::Sub(hn::Max(hn::Max(p0, p1), hn::Max(p2, p3)), hn::Min(hn::Min(p0, p1), hn::Min(p2, p3)));
    const auto larger = hn::Max(sizes, hn::Reverse2(pairs, sizes));
    const wide reach(hn::PromoteTo(DoubleTag(), hn::LowerHalf(HalfFloatTag(), hn::ConcatEven(pairs, larger, larger))));
    wide most(0.0), least(1e300);
    for (int k = 0; k < 4; ++k) {
        most = max(most, abs(cell.plane[k][1]) + abs(cell.plane[k][2]));
        least = min(least, abs(cell.plane[k][0]));
    }
    return most * reach > wide(8192.0) * least;
}

HWY_INLINE void keepInDouble(const ProjectedCell& cell, wide offsetX, wide offsetY, std::size_t j, SteepCells& steep) {
    const auto store = [&](wide value, double* to) HWY_ATTR { hn::StoreU(value.v, DoubleTag(), to + j); };
    for (std::size_t k = 0; k < 4; ++k)
        for (std::size_t i = 0; i < 3; ++i) store(cell.plane[k][i], steep.plane[k][i]);
    store(offsetX, steep.offsetX);
    store(offsetY, steep.offsetY);
    store(cell.scalar, steep.scalar);
    store(cell.scalarPerX, steep.scalarPerX);
    store(cell.scalarPerY, steep.scalarPerY);
    store(cell.scalarPerInverseDepth, steep.scalarPerInverseDepth);
}

/// Rectangles within the tile from the corners' pixels, as (x, y) pairs in float lanes; true when a corner lies behind
/// the eye.
HWY_INLINE bool batchRectangles(const TileFrame& frame, const hn::Vec<DoubleTag> (&pixels)[4], int tileX, int tileY,
                                std::size_t j, CellBatch& batch) {
    const hn::Repartition<float, DoubleTag> pairs;
    const hn::RebindToSigned<decltype(pairs)> ints;
    const auto p0 = hn::BitCast(pairs, pixels[0]), p1 = hn::BitCast(pairs, pixels[1]),
               p2 = hn::BitCast(pairs, pixels[2]), p3 = hn::BitCast(pairs, pixels[3]);
    const auto low = hn::Min(hn::Min(p0, p1), hn::Min(p2, p3)), high = hn::Max(hn::Max(p0, p1), hn::Max(p2, p3));
    const auto pad = hn::Set(pairs, pixelPadding(frame.width, frame.height));
    const auto origin =
        hn::BitCast(pairs, hn::Set(hn::Repartition<std::uint64_t, DoubleTag>(), packedPair(tileX, tileY)));
    const auto zero = hn::Zero(pairs), size = hn::Set(pairs, static_cast<float>(cpuTileSize));
    const auto begin = hn::Min(hn::Max(hn::Sub(hn::Ceil(hn::Sub(low, pad)), origin), zero), size);
    const auto end =
        hn::Min(hn::Max(hn::Sub(hn::Floor(hn::Add(high, pad)), hn::Sub(origin, hn::Set(pairs, 1.0f))), zero), size);
    hn::StoreU(hn::ConvertTo(ints, begin), ints, &batch.begin[j][0]);
    hn::StoreU(hn::ConvertTo(ints, end), ints, &batch.end[j][0]);
    const auto sum = hn::Add(hn::Add(p0, p1), hn::Add(p2, p3));  // NaN where one is
    return !hn::AllTrue(pairs, hn::Eq(sum, sum));
}

/// What is kept of a cell's gradient.
enum class GradientParts { None, Magnitude, All };

/// Whether float scalars of one of the cells say too little about its gradient: its direction errs by their rounding
/// over how much they differ, 3e-5 at most where this is false.
HWY_INLINE bool nearlyFlat(hn::Vec<HalfFloatTag> low, hn::Vec<HalfFloatTag> high) {
    const HalfFloatTag half;
    const auto few =
        hn::Max(hn::Mul(high, hn::Set(half, 1.0f / 512)), hn::Set(half, static_cast<float>(leastKeptRise)));
    return !hn::AllFalse(half, hn::Lt(hn::Sub(high, low), few));
}

/// The rises of cells j … from the field's own numbers: scalars may agree in float where the field's do not.
HWY_INLINE Triple fieldRise(const TileFrame& frame, const SortedCorners& corners, std::size_t j) {
    wide s[4];
    for (std::size_t k = 0; k < 4; ++k) {
        const auto index = hn::PromoteTo(
            DoubleIndexTag(), hn::LoadU(HalfIntTag(), frame.cellData ? &corners.cell[j] : &corners.point[k][j]));
        s[k] = hn::GatherIndex(DoubleTag(), frame.fieldScalars, index);
    }
    return sceneRise(riseOf(s), wide(frame.scalarScale));
}

/// Lanes j … of the batch: everything but what lies behind the eye.
template <bool Orthographic, GradientParts gradients>
HWY_INLINE bool setUpLanes(const TileFrame& frame, int tileX, int tileY, const SortedCorners& corners, std::size_t j,
                           CellBatch& batch) {
    const DoubleTag tag;
    const auto* coordinates = reinterpret_cast<const double*>(frame.points);
    Triple p[4];
    hn::Vec<DoubleTag> pixels[4];
    wide s[4];
    for (std::size_t k = 0; k < 4; ++k) {
        const auto index = hn::PromoteTo(DoubleIndexTag(), hn::LoadU(HalfIntTag(), &corners.point[k][j]));
        const auto row = hn::ShiftLeft<2>(index);
        const auto one = hn::Set(DoubleIndexTag(), 1);
        p[k].x = hn::GatherIndex(tag, coordinates, row);
        p[k].y = hn::GatherIndex(tag, coordinates, hn::Add(row, one));
        p[k].z = hn::GatherIndex(tag, coordinates, hn::Add(row, hn::Set(DoubleIndexTag(), 2)));
        pixels[k] = hn::GatherIndex(tag, coordinates, hn::Add(row, hn::Set(DoubleIndexTag(), 3)));
    }
    const HalfFloatTag half;
    hn::Vec<HalfFloatTag> scalars[4];
    for (std::size_t k = 0; k < 4; ++k) {
        scalars[k] = hn::GatherIndex(half, frame.scalars,
                                     hn::LoadU(HalfIntTag(), frame.cellData ? &corners.cell[j] : &corners.point[k][j]));
        s[k] = hn::PromoteTo(tag, scalars[k]);
    }
    const auto low = hn::Min(hn::Min(scalars[0], scalars[1]), hn::Min(scalars[2], scalars[3]));
    const auto high = hn::Max(hn::Max(scalars[0], scalars[1]), hn::Max(scalars[2], scalars[3]));
    hn::StoreU(low, half, &batch.scalarLow[j]);
    hn::StoreU(high, half, &batch.scalarHigh[j]);
    const bool special = batchRectangles(frame, pixels, tileX, tileY, j, batch);

    const auto forms = cellForms(p[0], p[1], p[2], p[3], Orthographic);
    const auto reference = centroidReference(forms, Orthographic);
    Triple rise = riseOf(s);
    if constexpr (gradients != GradientParts::None) {
        if (HWY_UNLIKELY(nearlyFlat(low, high))) rise = fieldRise(frame, corners, j);
    }
    const auto cell = projectCell(forms, reference, s, rise, Orthographic);

    const wide zero(0.0);
    const auto odd =
        hn::Ne(hn::PromoteTo(DoubleIndexTag(), hn::LoadU(HalfIntTag(), &corners.odd[j])), hn::Zero(DoubleIndexTag()));
    auto fronts = hn::Zero(DoubleIndexTag());
    for (std::size_t k = 0; k < 4; ++k) {
        const auto inside = hn::RebindMask(DoubleIndexTag(), forms.eye[k] < zero);
        fronts =
            hn::Or(fronts, hn::IfThenElseZero(hn::Xor(inside, odd), hn::Set(DoubleIndexTag(), std::int64_t{1} << k)));
        for (std::size_t i = 0; i < 3; ++i) storeFloats(cell.plane[k][i], &batch.plane[k][i][j]);
    }
    const hn::Rebind<std::uint32_t, DoubleTag> narrow;
    hn::StoreU(hn::TruncateTo(narrow, hn::BitCast(hn::RebindToUnsigned<DoubleTag>(), fronts)), narrow,
               &batch.frontMask[j]);
    storeFloats(cell.scalar, &batch.scalar[j]);
    storeFloats(cell.scalarPerX, &batch.scalarPerX[j]);
    storeFloats(cell.scalarPerY, &batch.scalarPerY[j]);
    storeFloats(cell.scalarPerInverseDepth, &batch.scalarPerInverseDepth[j]);
    storeFloats(reference.depth, &batch.scale[j]);
    const wide offsetX = wide(tileX - frame.centre.x) - reference.imageX,
               offsetY = wide(tileY - frame.centre.y) - reference.imageY;
    storeInTwo(offsetX, &batch.offsetX[j], &batch.restX[j]);
    storeInTwo(offsetY, &batch.offsetY[j], &batch.restY[j]);
    const wide_mask steep = steepCells(cell, pixels);
    storeFloats(wide(hn::IfThenElseZero(steep, hn::Set(tag, 1.0))), &batch.steep.is[j]);
    if (HWY_UNLIKELY(!hn::AllFalse(tag, steep))) keepInDouble(cell, offsetX, offsetY, j, batch.steep);

    const wide nearest = min(min(p[0].z, p[1].z), min(p[2].z, p[3].z)),
               deepest = max(max(p[0].z, p[1].z), max(p[2].z, p[3].z));
    const auto depths =
        depthBounds(frame.depthReference, reference.depth, reference.perDepth, nearest, deepest, Orthographic);
    storeFloats(depths.inverseDepthNear, &batch.inverseDepthNear[j]);
    storeFloats(depths.inverseDepthFar, &batch.inverseDepthFar[j]);
    storeFloats(depths.rayPerInverseDepth, &batch.rayPerInverseDepth[j]);
    storeFloats(depths.rayInverseDepth - wide(frame.orderTolerance) - depths.rounding,
                &batch.rayInverseDepthChecked[j]);
    storeFloats(depths.rayInverseDepth, &batch.rayInverseDepth[j]);
    if constexpr (gradients != GradientParts::None) {
        const wide inverse(1.0 / frame.pixel), lean(frame.rowLean), inverseRow(1.0 / (frame.pixel * frame.rowStretch));
        const wide gx = cell.gradient.x * inverse, gy = (cell.gradient.y - lean * cell.gradient.x) * inverseRow,
                   gz = cell.gradient.z;
        const wide magnitude = sqrt(gx * gx + gy * gy + gz * gz);
        // what is a gradient in double is one in float
        storeFloats(select(magnitude > zero, max(magnitude, wide(leastFloatGradient)), zero), &batch.gradient[j]);
        if constexpr (gradients == GradientParts::Magnitude) return special;
        const wide scale = select(magnitude > zero, wide(1.0) / magnitude, zero);
        storeFloats(gx * scale, &batch.normal[0][j]);
        storeFloats(gy * scale, &batch.normal[1][j]);
        storeFloats(gz * scale, &batch.normal[2][j]);
        if (frame.attributes) {
            wide perDeterminant = wide(1.0) / forms.determinant;
            if constexpr (Orthographic) perDeterminant = perDeterminant * abs(reference.depth);
            for (std::size_t k = 0; k < 4; ++k) {
                storeFloats(eyeBesideFace(forms, static_cast<int>(k)) * perDeterminant, &batch.eyeWeight[k][j]);
                hn::StoreU(hn::LoadU(HalfIntTag(), &corners.point[k][j]), HalfIntTag(), &batch.corner[k][j]);
            }
        }
    }
    return special;
}

/// Sets up the first (up to eight) of `entries`; the number of cells in the batch.
template <bool Orthographic, GradientParts gradients>
inline HWY_NOINLINE std::size_t setUpBatchAs(const TileFrame& frame, int tileX, int tileY,
                                             std::span<const TileEntry> entries, CellBatch& batch) {
    const std::size_t cells = std::min<std::size_t>(entries.size(), CellBatch::capacity);
    TileEntry padded[CellBatch::capacity];
    const TileEntry* eight = entries.data();
    if (HWY_UNLIKELY(cells < CellBatch::capacity)) {
        for (std::size_t j = 0; j < CellBatch::capacity; ++j) padded[j] = entries[std::min(j, cells - 1)];
        eight = padded;
    }
    SortedCorners corners;
    sortCorners(frame, eight, corners);
    bool special = false;
    for (std::size_t j = 0; j < cells; j += hn::Lanes(DoubleTag()))
        special |= setUpLanes<Orthographic, gradients>(frame, tileX, tileY, corners, j, batch);
    if (HWY_UNLIKELY(special))
        for (std::size_t j = 0; j < cells; ++j) {
            const std::int32_t points[4] = {corners.point[0][j], corners.point[1][j], corners.point[2][j],
                                            corners.point[3][j]};
            setUpCellAtEye(frame, tileX, tileY, points, entries[j].cell, corners.odd[j] != 0, j, batch);
        }
    if (frame.attributes && !frame.vertexLight->corners.empty()) takeRowsOfCells(frame, entries, cells, batch);
    return cells;
}

/// A function of its own, which all kernels share.
template <GradientParts gradients>
HWY_INLINE std::size_t setUpBatch(const TileFrame& frame, int tileX, int tileY, std::span<const TileEntry> entries,
                                  CellBatch& batch) {
    return frame.orthographic ? setUpBatchAs<true, gradients>(frame, tileX, tileY, entries, batch)
                              : setUpBatchAs<false, gradients>(frame, tileX, tileY, entries, batch);
}

}  // namespace tetralux::projection::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
