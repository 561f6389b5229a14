// SPDX-License-Identifier: Apache-2.0
/// \file
/// Scale-invariant tables grow from the diagonal outwards: a segment is its first step, composited over the rest, which is the neighbouring
/// texel (Lum, Wilson & Ma 2004, "High-quality lighting and efficient pre-integration for volume rendering", for the idea). All terms are
/// positive and every step is exact, so texels are too. In the standard integral neighbours differ in length as well, so each texel is an
/// exact integral of its own, but few slices along the length do, because mean colour varies slowly with it.
#include <preint/preintegration_table.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <stdexcept>

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <preint/table_error.h>
#include <preint/table_layout.h>
#include <preint/table_reader.h>
#include <preint/table_texels.h>

namespace tetralux::preint {
namespace {

constexpr int largestRows2D = 16384;  ///< zones·size: what OpenGL implementations allow
constexpr int largestRows3D = 2048;
constexpr int largestSize2D = 2048, largestSize3D = 512, largestSlices = 64;
constexpr std::size_t largestTexels = std::size_t{1} << 24;  ///< 256 MiB

using Clock = std::chrono::steady_clock;

double millisecondsSince(Clock::time_point start) {
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

std::size_t texelCount(const PreintegrationTable& table) {
    return static_cast<std::size_t>(table.size) * table.size * table.zones.size() * table.slices;
}

bool fits(const PreintegrationTable& table) {
    const bool flat = table.integral == Integral::ScaleInvariant;
    const int rows = table.size * static_cast<int>(table.zones.size());
    return rows <= (flat ? largestRows2D : largestRows3D) && table.size <= (flat ? largestSize2D : largestSize3D) &&
           table.slices <= largestSlices && texelCount(table) <= largestTexels;
}

/// What light meets on one step between neighbouring texels.
struct Step {
    glm::dvec3 color;
    double opacity, transmittance;
};

Step stepOf(const SegmentResult& segment) { return {segment.color, segment.opacity(), segment.transmittance()}; }

/// One zone of a scale-invariant table, row by row.
class ZoneRecurrence {
public:
    ZoneRecurrence(const ExactIntegral& exact, const TableTexels& texels, const glm::dvec2& zone, int size)
        : exact_(exact), texels_(texels), zone_(zone), size_(size), depth_(size, 0.0) {
        for (int i = 0; i < size; ++i) scalar_.push_back(texels.scalarOf(zone, i));
        for (int i = 0; i + 1 < size; ++i) {
            const SegmentResult up = exact.smoothSegment(scalar_[i], scalar_[i + 1], 0.0, Integral::ScaleInvariant);
            rising_.push_back(stepOf(up));
            falling_.push_back(stepOf(exact.smoothSegment(scalar_[i + 1], scalar_[i], 0.0, Integral::ScaleInvariant)));
            depth_[i + 1] = depth_[i] + up.opticalDepth;
        }
    }

    /// All texels with back scalar j: front scalars from the diagonal outwards on both sides.
    void fillRow(int j, glm::vec4* row) const {
        row[j] = texels_.diagonal(scalar_[j], zone_);
        glm::dvec3 color{0.0};
        double opacity = 0.0;
        auto prepend = [&](const Step& step, int i) {
            color = step.color + step.transmittance * color;
            opacity = step.opacity + step.transmittance * opacity;
            row[i] = entry(color, opacity, i, j);
        };
        for (int i = j; i-- > 0;) prepend(rising_[i], i);
        color = glm::dvec3{0.0};
        opacity = 0.0;
        for (int i = j + 1; i < size_; ++i) prepend(falling_[i - 1], i);
    }

private:
    glm::vec4 entry(const glm::dvec3& color, double opacity, int i, int j) const {
        if (scalar_[i] == scalar_[j]) return texels_.diagonal(scalar_[i], zone_);
        const double meanExtinction = std::abs(depth_[j] - depth_[i]) / std::abs(scalar_[j] - scalar_[i]);
        constexpr double leastOpacity = 1e-290;
        const glm::dvec3 mean =
            opacity > leastOpacity
                ? color / opacity
                : exact_.nearestVisibleColor(std::min(scalar_[i], scalar_[j]), std::max(scalar_[i], scalar_[j]), zone_.x, zone_.y);
        return glm::vec4(glm::dvec4(mean, meanExtinction));
    }

    const ExactIntegral& exact_;
    const TableTexels& texels_;
    glm::dvec2 zone_;
    int size_;
    std::vector<double> scalar_, depth_;
    std::vector<Step> rising_, falling_;  // [i]: between texels i and i + 1
};

void fillScaleInvariant(const ExactIntegral& exact, PreintegrationTable& table) {
    const TableTexels texels(exact, table);
    for (std::size_t zone = 0; zone < table.zones.size(); ++zone) {
        const ZoneRecurrence recurrence(exact, texels, table.zones[zone], table.size);
        tbb::parallel_for(tbb::blocked_range<int>(0, table.size), [&](const tbb::blocked_range<int>& rows) {
            for (int j = rows.begin(); j < rows.end(); ++j) {
                recurrence.fillRow(j, &table.texels[(zone * table.size + j) * table.size]);
            }
        });
    }
}

void fillStandard(const ExactIntegral& exact, PreintegrationTable& table) {
    const TableTexels texels(exact, table);
    const int rows = table.size * static_cast<int>(table.zones.size());
    tbb::parallel_for(tbb::blocked_range<int>(0, rows * table.slices), [&](const tbb::blocked_range<int>& range) {
        for (int line = range.begin(); line < range.end(); ++line) {
            glm::vec4* out = &table.texels[static_cast<std::size_t>(line) * table.size];
            for (int i = 0; i < table.size; ++i) out[i] = texels.texel(i, line % rows, line / rows);
        }
    });
}

/// Grows size and slices, each time the one that helps more, until look-up keeps `wantedError` or nothing larger fits.
void chooseSize(const ExactIntegral& exact, const TableOptions& options, const std::vector<SampleRay>& rays, PreintegrationTable& table) {
    const bool flat = table.integral == Integral::ScaleInvariant;
    table.size = options.size > 0 ? options.size : 32;
    table.slices = flat ? 1 : options.lengthSlices > 0 ? options.lengthSlices : 4;
    while (options.size <= 0 && !fits(table) && table.size > 2) table.size /= 2;  // very many zones
    if (!fits(table)) {
        throw std::runtime_error(fmt::format("table of {} zones of {}×{}×{} texels is too large; ask for a smaller size", table.zones.size(),
                                             table.size, table.size, table.slices));
    }
    const bool growSize = options.size <= 0, growSlices = !flat && options.lengthSlices <= 0;
    if (!growSize && !growSlices) return;
    double error = lookUpError(exact, table, rays);
    while (error > options.wantedError) {
        PreintegrationTable finer = table, deeper = table;
        finer.size *= 2;
        deeper.slices *= 2;
        const bool canGrowSize = growSize && fits(finer), canGrowSlices = growSlices && fits(deeper);
        const double finerError = canGrowSize ? lookUpError(exact, finer, rays) : HUGE_VAL;
        const double deeperError = canGrowSlices ? lookUpError(exact, deeper, rays) : HUGE_VAL;
        if (!canGrowSize && !canGrowSlices) break;
        table = deeperError < finerError ? deeper : finer;
        error = std::min(finerError, deeperError);
    }
}

template <class Fill>
PreintegrationTable build(const ExactIntegral& exact, PreintegrationTable table, const TableOptions& options, double scalarMin, double scalarMax,
                          const Fill& fill) {
    if (options.size < 0 || options.size == 1) {
        throw std::runtime_error(fmt::format("table size {} is not possible; give at least 2 texels, or 0 to have it chosen", options.size));
    }
    const auto start = Clock::now();
    tbb::task_arena arena(options.threads > 0 ? options.threads : tbb::task_arena::automatic);
    arena.execute([&] {
        layOutTable(exact, scalarMin, scalarMax, table);
        const std::vector<SampleRay> rays = sampleRays(exact, table);
        chooseSize(exact, options, rays, table);
        table.texels.resize(texelCount(table));
        fill(exact, table);
        table.measuredError = lookUpError(table, rays);
    });
    table.buildMilliseconds = millisecondsSince(start);
    return table;
}

}  // namespace

PreintegrationTable buildScaleInvariantTable(const ExactIntegral& exact, double scalarMin, double scalarMax, const TableOptions& options) {
    PreintegrationTable table;
    table.integral = Integral::ScaleInvariant;
    return build(exact, std::move(table), options, scalarMin, scalarMax, fillScaleInvariant);
}

PreintegrationTable buildStandardTable(const ExactIntegral& exact, double scalarMin, double scalarMax, double lengthMax,
                                       const TableOptions& options) {
    if (!(lengthMax > 0.0) || !std::isfinite(lengthMax)) {
        throw std::runtime_error(fmt::format("largest length {} of a pre-integration table must be positive and finite", lengthMax));
    }
    PreintegrationTable table;
    table.integral = Integral::Standard;
    table.lengthMax = lengthMax;
    const double extinction = exact.largestExtinction(scalarMin, scalarMax);
    table.lengthScale = extinction > 0.0 ? std::min(1.0 / extinction, 1e3 * lengthMax) : lengthMax;
    return build(exact, std::move(table), options, scalarMin, scalarMax, fillStandard);
}

SegmentResult lookUpSegment(const PreintegrationTable& table, double front, double back, double length) {
    const int rows = table.size * static_cast<int>(table.zones.size());
    const auto fetch = [&table, rows](int i, int row, int k) {
        return glm::dvec4(table.texels[(static_cast<std::size_t>(k) * rows + row) * table.size + i]);
    };
    return TableReader(table, fetch).segment(front, back, length);
}

}  // namespace tetralux::preint
