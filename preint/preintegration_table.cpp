// SPDX-License-Identifier: Apache-2.0
/// \file
/// Scale-invariant tables grow from the diagonal outwards: a segment is its first step, composited over the rest, which
/// is the neighbouring texel (Lum, Wilson & Ma 2004, "High-quality lighting and efficient pre-integration for volume
/// rendering", for the idea). All terms are positive and every step is exact, so texels are too. In the standard
/// integral neighbours differ in length as well, so each texel is an exact integral of its own, but few slices along
/// the length do, because mean colour varies slowly with it.
#include <preint/preintegration_table.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

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
constexpr std::size_t quickTexels = std::size_t{1} << 20;    ///< 16 MiB: the most that is paid for quick look-ups
/// Depth up to which slices lie evenly: mean colour bends at depths about 1, but counts there less than where light is
/// absorbed. From 2 to 8 errors of tables with 4 to 16 slices differ little; 1 doubles them.
constexpr double evenDepth = 5.0;

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

Step stepOf(const SegmentResult& segment) {
    return {segment.color, segment.opacity(), segment.transmittance()};
}

/// One zone of a scale-invariant table, row by row.
class ZoneRecurrence {
public:
    ZoneRecurrence(const ExactIntegral& exact, const TableTexels& texels, const glm::dvec2& zone, const double* scalars,
                   int size)
        : exact_(exact),
          texels_(texels),
          zone_(zone),
          size_(size),
          scalar_(scalars, scalars + size),
          depth_(size, 0.0) {
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
        const glm::dvec3 mean = opacity > leastOpacity
                                    ? color / opacity
                                    : exact_.nearestVisibleColor(std::min(scalar_[i], scalar_[j]),
                                                                 std::max(scalar_[i], scalar_[j]), zone_.x, zone_.y);
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
        const ZoneRecurrence recurrence(exact, texels, table.zones[zone], &table.texelScalars[zone * table.size],
                                        table.size);
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

/// The first size from the table's own to a quarter more at which every kink falls on a texel centre of evenly laid
/// texels; the table's own when there is none.
int sizeMeeting(const ZoneKinks& kinks, const PreintegrationTable& table) {
    constexpr double near = 0.01;  // texels
    const auto meets = [&](int size) {
        for (std::size_t z = 0; z < kinks.size(); ++z) {
            const glm::dvec2& zone = table.zones[z];
            for (const double kink : kinks[z]) {
                const double texel = (kink - zone.x) / (zone.y - zone.x) * (size - 1);
                if (std::abs(texel - std::round(texel)) > near) return false;
            }
        }
        return true;
    };
    for (int size = table.size; size <= table.size + table.size / 4; ++size) {
        if (meets(size)) return size;
    }
    return table.size;
}

/// The smallest table that keeps a wanted error.
class SizeChooser {
public:
    SizeChooser(const ExactIntegral& exact, const TableOptions& options, double scalarMin, double scalarMax)
        : exact_(exact), options_(options), scalarMin_(scalarMin), scalarMax_(scalarMax) {}

    /// Lays `table` out: the first of several ways that keeps the error, or the one that comes closest. Even texels
    /// make look-up cheapest; warp and ramps, or cuts at kinks, each double the time of a frame on llvmpipe (bucky ball
    /// of 149k cells, 256², six kinks: 0.30, 0.61 and 0.61 s of processor time). Cuts need the smallest table by far.
    /// (Five nodes, standard, 512²: a warped table of 512×512×4 took 0.65 to 0.75 of the time of one of 32×32×4 with
    /// cuts.)
    void choose(PreintegrationTable& table) {
        const std::pair<KinkCuts, std::size_t> ways[] = {
            // where nothing shows on one side of a kink there is no mean colour to interpolate with
            {KinkCuts::All, options_.meanColors ? quickTexels : 0},
            {KinkCuts::Ignored, options_.evenTexelsFirst && !isSteep(table) ? quickTexels : 0},
            {KinkCuts::None, quickTexels},
            {KinkCuts::All, largestTexels},
            {KinkCuts::None, largestTexels}};
        const PreintegrationTable empty = table;
        double least = HUGE_VAL;
        for (const auto& [cuts, texels] : ways) {
            if (texels == 0) continue;
            PreintegrationTable candidate = empty;
            const double error = grown(candidate, cuts, texels);
            if (error < least) {
                least = error;
                table = std::move(candidate);
            }
            if (least <= options_.wantedError) return;
        }
    }

    /// The rays by which sizes were judged.
    const std::vector<SampleRay>& rays() const { return rays_; }
    Compared compared() const { return options_.meanColors ? Compared::MeanColor : Compared::PremultipliedColor; }

private:
    /// Whether a sampler's rounding of texel coordinates, some 2e-6 of a texel, may show where extinction comes from
    /// texels: at the foot of a ramp it is all that there is.
    bool isSteep(const PreintegrationTable& table) const {
        constexpr double mostDepth = 500.0;
        return table.integral == Integral::Standard &&
               exact_.largestExtinction(scalarMin_, scalarMax_) * table.lengthMax > mostDepth;
    }

    /// The layout with the size that suits it, of at most `mostTexels` unless the options ask for more; returns its
    /// error.
    double grown(PreintegrationTable& table, KinkCuts cuts, std::size_t mostTexels) {
        kinks_ = layOutTable(exact_, scalarMin_, scalarMax_, cuts, table);
        kinksToMeet_ = cuts == KinkCuts::Ignored ? std::exchange(kinks_, ZoneKinks(kinks_.size())) : ZoneKinks();
        if (rays_.empty()) rays_ = sampleRays(exact_, table);
        const bool flat = table.integral == Integral::ScaleInvariant;
        table.size = options_.size > 0 ? options_.size : 32;
        table.slices = flat ? 1 : options_.lengthSlices > 0 ? options_.lengthSlices : 4;
        while (options_.size <= 0 && !fits(table) && table.size > 2) table.size /= 2;  // very many zones
        if (!fits(table)) {
            if (cuts == KinkCuts::All) return HUGE_VAL;
            throw std::runtime_error(
                fmt::format("table of {} zones of {}×{}×{} texels is too large; ask for a smaller size",
                            table.zones.size(), table.size, table.size, table.slices));
        }
        if (options_.size <= 0) table.size = sizeMeeting(kinksToMeet_, table);
        placeTexels(kinks_, table);
        double error = lookUpError(exact_, table, rays_, compared());
        while (error > options_.wantedError && grow(table, error, mostTexels)) {
        }
        return error;
    }

    /// Doubles size or slices, whichever helps more, or both when neither helps alone; false when nothing does. Twice
    /// the texels should quarter the error; an axis that does not even gain a tenth is not what the error comes from.
    bool grow(PreintegrationTable& table, double& error, std::size_t mostTexels) const {
        constexpr double leastGain = 0.9;
        const bool growSize = options_.size <= 0;
        const bool growSlices = table.integral == Integral::Standard && options_.lengthSlices <= 0;
        PreintegrationTable finer = table, deeper = table, both = table;
        const double finerError = growSize ? errorOfGrown(finer, 2, 1, mostTexels) : HUGE_VAL;
        const double deeperError =
            growSlices && finerError > options_.wantedError ? errorOfGrown(deeper, 1, 2, mostTexels) : HUGE_VAL;
        const bool oneHelps = std::min(finerError, deeperError) < leastGain * error;
        const double bothError = !oneHelps && growSize && growSlices ? errorOfGrown(both, 2, 2, mostTexels) : HUGE_VAL;
        const double best = std::min({finerError, deeperError, bothError});
        if (!(best < leastGain * error)) return false;
        table = best == finerError ? finer : best == deeperError ? deeper : both;
        error = best;
        return true;
    }

    double errorOfGrown(PreintegrationTable& table, int sizeFactor, int sliceFactor, std::size_t mostTexels) const {
        table.size *= sizeFactor;
        table.slices *= sliceFactor;
        if (sizeFactor > 1) table.size = sizeMeeting(kinksToMeet_, table);
        if (!fits(table) || texelCount(table) > mostTexels) return HUGE_VAL;
        placeTexels(kinks_, table);
        return lookUpError(exact_, table, rays_, compared());
    }

    const ExactIntegral& exact_;
    const TableOptions& options_;
    double scalarMin_, scalarMax_;
    ZoneKinks kinks_;
    ZoneKinks kinksToMeet_;  // of even texels: by luck, with nodes at round fractions, or not at all
    std::vector<SampleRay> rays_;
};

template <class Fill>
PreintegrationTable build(const ExactIntegral& exact, PreintegrationTable table, const TableOptions& options,
                          double scalarMin, double scalarMax, const Fill& fill) {
    if (options.size < 0 || options.size == 1) {
        throw std::runtime_error(
            fmt::format("table size {} is not possible; give at least 2 texels, or 0 to have it chosen", options.size));
    }
    const auto start = Clock::now();
    SizeChooser chooser(exact, options, scalarMin, scalarMax);
    chooser.choose(table);
    table.texels.resize(texelCount(table));
    fill(exact, table);
    table.measuredError = lookUpError(table, chooser.rays(), chooser.compared());
    table.buildMilliseconds = millisecondsSince(start);
    return table;
}

}  // namespace

PreintegrationTable buildScaleInvariantTable(const ExactIntegral& exact, double scalarMin, double scalarMax,
                                             const TableOptions& options) {
    PreintegrationTable table;
    table.integral = Integral::ScaleInvariant;
    return build(exact, std::move(table), options, scalarMin, scalarMax, fillScaleInvariant);
}

PreintegrationTable buildStandardTable(const ExactIntegral& exact, double scalarMin, double scalarMax, double lengthMax,
                                       const TableOptions& options) {
    if (!(lengthMax > 0.0) || !std::isfinite(lengthMax)) {
        throw std::runtime_error(
            fmt::format("largest length {} of a pre-integration table must be positive and finite", lengthMax));
    }
    PreintegrationTable table;
    table.integral = Integral::Standard;
    table.lengthMax = lengthMax;
    const double extinction = exact.largestExtinction(scalarMin, scalarMax);
    table.lengthScale = extinction > 0.0 ? std::min(evenDepth / extinction, 1e3 * lengthMax) : lengthMax;
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
