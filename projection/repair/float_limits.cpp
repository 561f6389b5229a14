// SPDX-License-Identifier: Apache-2.0
//
// Ramps. On a ramp of extinction of slope k a scalar that errs by ε makes depth err by k·ε·l over a length l. What
// shows is the error of transmittance, exp(−depth) times that, which leaves it little room:
// - Relative to depth the error is k·ε/τ, and depth·exp(−depth) ≤ 1/e. So where τ is large enough throughout a cell
//   nothing shows: only cells that reach down to the foot of a ramp are left, where τ → 0. This takes extinction that
//   is computed from the foot on (CpuTransfer): then the rounding of scalars is all that errs.
// - A ray that crosses the foot in a cell of range w and length L and sees scalars up to Δ above it has depth
//   d = k·L·Δ²/(2w), which errs by k·ε·L·Δ/w = √(2d·k·L/w)·ε. √(2d)·exp(−d) ≤ exp(−1/2): transmittance errs by
//   √(k·L/w)·ε·exp(−1/2) at most, and by k·ε·L in cells so close to the foot, k·L·w < 1, that they are not opaque.
// - Rays along the foot err by more, but those with scalars within 1/(k·L) of it are all that is not opaque, and of
//   the cell's rays only a share of 1/(k·L·w) runs there: ε/w in the mean.
// - ε is a few roundings of the largest scalar of the cell (scene units), not of the field's range: a foot at the
// field's
//   least value is met with the relative precision of float.
// Silhouettes divide depth by |n·d|, as if L were that much longer; for one ray in mostOblique it is longer still.
//
// In the scale-invariant integral the length is the scalar's step, L = w; and since that is the difference of two
// scalars, τ·ε is an error as well where the cell is so flat that all of it shows. (With silhouettes it is not: depth
// follows from the gradient then.) In others it falls to rays that nearly keep their scalar, and what such a ray misses
// in one cell it meets in the next, which has the same scalar where they touch.
#include <projection/repair/float_limits.h>

#include <algorithm>
#include <array>
#include <cmath>

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <glm/geometric.hpp>

#include <projection/core/lowered_isosurfaces.h>
#include <projection/core/transfer_support.h>

namespace tetralux::projection {

namespace {

constexpr double largestDepthError = 1e-3;
constexpr double planeError = 1e-7;             // of the longest edge
constexpr double obliqueness = 3.0;             // of the error of a length over that of a plane
constexpr double largestScalarError = 3e-4;     // of a cell's range, where an isosurface may be crossed
constexpr double scalarRounding = 4 * 0x1p-24;  // of a cell's largest scene scalar: value, two rates, and their sum
constexpr double largestTableRise = 5e2;        // of the depth within a cell; chosen by trial: 3e3 left rmse of 1e-3
constexpr double opaqueDepth = 20.0;            // exp(−20) is below float's step: more or less depth does not show
constexpr double mostOblique = 16.0;
constexpr double largestTieShift = 1e-2;  // of a cell's range, by which an isosurface stands elsewhere in float

struct CellScalars {
    double low, high;
    double width() const { return high - low; }
};

CellScalars scalarsOf(const mesh::ScalarMesh& mesh, mesh::CellIndex cell) {
    const glm::dvec2 range = scalarRange(mesh, cell);
    return {range.x, range.y};
}

struct CellShape {
    double longestEdge, leastAltitude;
};

CellShape shapeOf(const mesh::ScalarMesh& mesh, mesh::CellIndex cell) {
    std::array<glm::dvec3, 4> p;
    for (std::size_t k = 0; k < 4; ++k) p[k] = mesh.positions[mesh.cells[cell][k]];
    double longest = 0, largestFace = 0;
    for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t j = i + 1; j < 4; ++j) longest = std::max(longest, glm::distance(p[i], p[j]));
    for (const auto& face : mesh::faceVertices) {
        const glm::dvec3& a = p[static_cast<std::size_t>(face[0])];
        const glm::dvec3 ab = p[static_cast<std::size_t>(face[1])] - a, ac = p[static_cast<std::size_t>(face[2])] - a;
        largestFace =
            std::max(largestFace, glm::length(glm::cross(ab / longest, ac / longest)));  // in range for any size
    }
    const double volume = std::abs(mesh::sixVolumes(p[0] / longest, p[1] / longest, p[2] / longest, p[3] / longest));
    return {longest, largestFace > 0 ? longest * volume / largestFace : 0.0};
}

/// Extinction among the scalars of a cell.
struct Extinctions {
    double least, most;
};

Extinctions extinctionsOf(const preint::TransferFunction& function, const CellScalars& scalars) {
    const double a = function.extinctionAt(scalars.low), b = function.extinctionAt(scalars.high);
    Extinctions found{std::min(a, b), std::max(a, b)};
    for (const auto& node : function.extinction)
        if (node.scalar >= scalars.low && node.scalar <= scalars.high)
            found = {std::min(found.least, node.extinction), std::max(found.most, node.extinction)};
    return found;
}

/// One kind of picture of one mesh.
class FloatLimits {
public:
    FloatLimits(const mesh::ScalarMesh& mesh, const preint::TransferFunction& function, preint::Integral integral,
                const FloatUse& use)
        : mesh_(mesh),
          function_(function),
          standard_(integral == preint::Integral::Standard),
          use_(use),
          inTable_(inTable()),
          range_(mesh.scalarMax - mesh.scalarMin),
          oblique_(use.silhouettes ? mostOblique : 1.0) {
        // no cell is longer than the mesh or ranges wider: most scenes end here
        double strongest = 0, steepest = 0;
        for (const auto& node : function.extinction) strongest = std::max(strongest, node.extinction);
        for (std::size_t i = 0; i + 1 < function.extinction.size(); ++i) steepest = std::max(steepest, slopeFrom(i));
        const double length = mesh.bounds.diagonal(), path = standard_ ? length : range_;
        const double most = standard_ ? strongest * length * planeError * obliqueness * oblique_ : strongest * range_;
        depthMayErr_ = most > largestDepthError;
        rampsMayErr_ = steepest * range_ * scalarRounding * path * oblique_ > largestDepthError ||
                       (inTable_ && strongest * length > largestTableRise);
    }

    bool anything() const { return depthMayErr_ || rampsMayErr_ || use_.scalarsShow || !function_.isosurfaces.empty(); }

    bool beyond(mesh::CellIndex cell) const {
        const CellScalars scalars = scalarsOf(mesh_, cell);
        return (depthMayErr_ && missesDepth(cell, scalars)) || (rampsMayErr_ && missesRamp(cell, scalars)) ||
               missesIsosurface(cell, scalars);
    }

private:
    /// Tables that hold extinction as ramps lose nothing of it as long as it only rises (table_layout.cpp).
    bool inTable() const {
        constexpr std::size_t mostRamps = 15;
        return use_.fromTable && standard_ &&
               (function_.extinction.size() > mostRamps ||
                !std::is_sorted(function_.extinction.begin(), function_.extinction.end(),
                                [](const auto& a, const auto& b) { return a.extinction < b.extinction; }));
    }

    /// Slope of the ramp between two nodes of extinction; a jump has none.
    double slopeFrom(std::size_t i) const {
        const auto &a = function_.extinction[i], &b = function_.extinction[i + 1];
        return b.scalar > a.scalar ? std::abs(b.extinction - a.extinction) / (b.scalar - a.scalar) : 0.0;
    }

    /// By how much the cell's scalars err on their way to a ray.
    double scalarError(const CellScalars& scalars) const {
        return scalarRounding * std::max(scalars.high - mesh_.scalarMin, 0.0);
    }

    bool missesDepth(mesh::CellIndex cell, const CellScalars& scalars) const {
        const auto [least, most] = extinctionsOf(function_, scalars);
        if (!standard_ && most * std::max(scalars.width(), scalarError(scalars)) <= largestDepthError) return false;
        const CellShape shape = shapeOf(mesh_, cell);
        const double altitude = std::max(shape.leastAltitude, 1e-300);
        if (standard_) {
            const double lengthError = shape.longestEdge * planeError * obliqueness;
            // what is visible of a segment that is as long as the cell is thick errs as its length does
            return least * altitude <= opaqueDepth &&
                   std::min(most * oblique_, opaqueDepth / altitude) * lengthError > largestDepthError;
        }
        const double depth = least * scalars.width() > opaqueDepth ? 0.0 : most * scalars.width();
        // tables have no digits to spare: the spacing of texels is added to what rounding does
        const double seen = use_.fromTable ? most * scalars.width() : std::min(depth, opaqueDepth);
        if (seen * std::min(1.0, planeError * shape.longestEdge / altitude) > largestDepthError) return true;
        return !use_.silhouettes &&
               most * scalarError(scalars) * std::exp(-least * scalars.width()) > largestDepthError &&
               depth < opaqueDepth && scalars.width() > 0;
    }

    bool missesRamp(mesh::CellIndex cell, const CellScalars& scalars) const {
        const CellShape shape = shapeOf(mesh_, cell);
        double path = shape.longestEdge * oblique_;
        if (!standard_) {
            path = scalars.width();
            if (use_.silhouettes) path *= oblique_ * shape.longestEdge / std::max(shape.leastAltitude, 1e-300);
        }
        double rise = 0;
        for (std::size_t i = 0; i + 1 < function_.extinction.size(); ++i) {
            const auto &a = function_.extinction[i], &b = function_.extinction[i + 1];
            if (!(b.scalar > a.scalar) || a.scalar > scalars.high || b.scalar < scalars.low) continue;
            const double begin = std::max(a.scalar, scalars.low), end = std::min(b.scalar, scalars.high);
            const auto extinctionAt = [&](double s) {
                const double t = (s - a.scalar) / (b.scalar - a.scalar);
                return (1.0 - t) * a.extinction + t * b.extinction;
            };
            const double least = std::min(extinctionAt(begin), extinctionAt(end)), slope = slopeFrom(i);
            rise = std::max(rise, slope * (end - begin));
            if (footError(slope, least, path, scalars) > largestDepthError) return !opaque(scalars, shape);
        }
        return inTable_ && rise * shape.longestEdge > largestTableRise && !opaque(scalars, shape);
    }

    /// The error of transmittance on a ramp whose extinction is at least `least` in the cell.
    double footError(double slope, double least, double path, const CellScalars& scalars) const {
        const double error = scalarError(scalars), deepest = slope * path * scalars.width();
        if (slope * error <= std::exp(1.0) * largestDepthError * least) return 0.0;
        return slope * path * error * (deepest > 1.0 ? std::exp(-0.5) / std::sqrt(deepest) : 1.0);
    }

    bool opaque(const CellScalars& scalars, const CellShape& shape) const {
        const double path = standard_ ? shape.leastAltitude : scalars.width();
        return extinctionsOf(function_, scalars).least * path > opaqueDepth;
    }

    /// Whether an isosurface may be met twice or never, since both sides of a face must agree about its scalar.
    bool missesIsosurface(mesh::CellIndex cell, const CellScalars& scalars) const {
        bool crossed = use_.scalarsShow;
        for (const auto& surface : function_.isosurfaces) {
            if (!(surface.opacity > 0)) continue;
            crossed = crossed || (surface.value >= scalars.low && surface.value <= scalars.high);
            if (tied(scalars, surface.value)) return true;
        }
        if (!crossed) return false;
        const CellShape shape = shapeOf(mesh_, cell);
        return planeError * shape.longestEdge > largestScalarError * shape.leastAltitude;
    }

    /// Whether scalars that hardly differ lie between the places of an isosurface in double and in float, or the latter
    /// within rounding.
    bool tied(const CellScalars& scalars, double value) const {
        const double farthest = (floatTie + scalarRounding) * range_;
        return scalars.width() * largestTieShift < farthest && scalars.low < value - doubleTie * range_ &&
               scalars.high >= value - farthest;
    }

    const mesh::ScalarMesh& mesh_;
    const preint::TransferFunction& function_;
    const bool standard_;
    const FloatUse use_;
    const bool inTable_;
    const double range_, oblique_;
    bool depthMayErr_ = false, rampsMayErr_ = false;
};

}  // namespace

std::vector<mesh::CellIndex> cellsBeyondFloat(const mesh::ScalarMesh& mesh, const preint::TransferFunction& function,
                                              preint::Integral integral, const FloatUse& use) {
    const FloatLimits limits(mesh, function, integral, use);
    if (!limits.anything()) return {};
    tbb::enumerable_thread_specific<std::vector<mesh::CellIndex>> found;
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, mesh.cells.size(), 4096), [&](const auto& range) {
        auto& mine = found.local();
        for (std::size_t i = range.begin(); i != range.end(); ++i)
            if (limits.beyond(static_cast<mesh::CellIndex>(i))) mine.push_back(static_cast<mesh::CellIndex>(i));
    });
    std::vector<mesh::CellIndex> all;
    for (const auto& part : found) all.insert(all.end(), part.begin(), part.end());
    std::sort(all.begin(), all.end());
    return all;
}

}  // namespace tetralux::projection
