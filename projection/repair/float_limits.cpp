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
//   field's least value is met with the relative precision of float.
// Silhouettes divide depth by |n·d|, as if L were that much longer; for one ray in mostOblique it is longer still.
//
// In the scale-invariant integral the length is the scalar's step, L = w; and since that is the difference of two
// scalars, τ·ε is an error as well where the cell is so flat that all of it shows. (With silhouettes it is not: depth
// follows from the gradient then.) In others it falls to rays that nearly keep their scalar, and what such a ray misses
// in one cell it meets in the next, which has the same scalar where they touch.
//
// On a ramp of colour of slope k the colour errs by k·ε, in the share of the cell's scalars that the ramp has. At a
// jump floats stand on the other side of it within ε: a share ε/w of the cell, all of it where w is below ε.
#include <projection/repair/float_limits.h>

#include <algorithm>
#include <array>
#include <cmath>

#include <glm/geometric.hpp>

#include <projection/cells/cell_constants.h>
#include <projection/core/gathered.h>
#include <projection/core/perturbed_isosurfaces.h>
#include <projection/core/transfer_support.h>
#include <projection/repair/cell_measures.h>

namespace tetralux::projection {

namespace {

constexpr double largestHiddenError = 1e-3,
                 largestSummedError = 1e-4;     // of depth: where it hides, and where it adds up
constexpr double planeError = 1e-7;             // of the longest edge
constexpr double obliqueness = 3.0;             // of the error of a length over that of a plane
constexpr double largestScalarError = 3e-4;     // of a cell's range, where an isosurface may be crossed
constexpr double scalarRounding = 4 * 0x1p-24;  // of a cell's largest scene scalar: value, two rates, and their sum
constexpr double largestTableRise = 5e2;        // of the depth within a cell; chosen by trial: 3e3 left rmse of 1e-3
constexpr double opaqueDepth = 20.0;            // exp(−20) is below float's step: more or less depth does not show
constexpr double mostOblique = 16.0;
constexpr double largestPerturbation = 1e-2;  // of a cell's range, by which an isosurface stands elsewhere in float
constexpr double largestColorError = 1e-4;
constexpr double largestHiddenShare = 0.25;  // of a cell, which float takes for nothing or for something
constexpr double mostLostErrors = 4.0;       // of the scalar: narrower parts of a cell's scalars may be lost
constexpr double leastFloat = 2e-38;         // scene scalars below it are none to float
constexpr double levelFace = 64.0;           // a face whose scalars differ by fewer of its errors is level to float

/// How far it is through the mesh if it is a sheet: its volume over the square of its extent.
double thicknessOf(const mesh::ScalarMesh& mesh) {
    double volume = 0;
    for (const mesh::Tetrahedron& cell : mesh.cells) {
        const auto at = [&](std::size_t k) { return mesh.positions[cell[k]] / mesh.bounds.diagonal(); };
        volume += std::abs(mesh::sixVolumes(at(0), at(1), at(2), at(3))) / 6.0;
    }
    return volume * mesh.bounds.diagonal();
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
          oblique_(use.silhouettes ? mostOblique : 1.0),
          thickness_(use.gathers == FloatUse::Gathers::Mean ? thicknessOf(mesh) : 0.0) {
        // no cell is longer than the mesh or ranges wider: most scenes end here
        double strongest = 0, steepest = 0;
        for (const auto& node : function.extinction) strongest = std::max(strongest, node.extinction);
        for (std::size_t i = 0; i + 1 < function.extinction.size(); ++i) steepest = std::max(steepest, slopeFrom(i));
        const double length = mesh.bounds.diagonal(), path = standard_ ? length : range_;
        const double most = standard_ ? strongest * length * planeError * obliqueness * oblique_ : strongest * range_;
        depthMayErr_ = most > largestDepthError();
        rampsMayErr_ = steepest * range_ * scalarRounding * path * oblique_ > largestDepthError() ||
                       (inTable_ && strongest * length > largestTableRise);
        double steepestColor = 0;
        for (std::size_t i = 0; i + 1 < function.color.size(); ++i)
            steepestColor = std::max(steepestColor, colorSlopeFrom(i));
        colorsMayErr_ = steepestColor * range_ * scalarRounding > largestColorError;
        colorsMayErrInFlatCells_ = depthMayErr_ && steepestColor > 0;
        jumps_ = jumpsOf(function);
        support_ = extinctionSupport(function);
    }

    bool anything() const {
        if (use_.gathers == FloatUse::Gathers::Mean) return true;
        if (use_.gathers == FloatUse::Gathers::Extreme) return function_.color.size() > 1;
        if (use_.gathers == FloatUse::Gathers::Crossings) return !function_.isosurfaces.empty() || !support_.empty();
        return depthMayErr_ || rampsMayErr_ || colorsMayErr_ || !jumps_.empty() || use_.scalarsShow ||
               !function_.isosurfaces.empty();
    }

    bool beyond(mesh::CellIndex cell) const {
        const CellScalars scalars = scalarsOf(mesh_, cell);
        switch (use_.gathers) {
            case FloatUse::Gathers::Extreme:
                return missesExtreme(cell, scalars);
            case FloatUse::Gathers::Mean:
                return missesMean(cell);
            case FloatUse::Gathers::Crossings:
                return missesIsosurface(cell, scalars) || missesBeginning(cell, scalars);
            case FloatUse::Gathers::Light:
                break;
        }
        return (depthMayErr_ && missesDepth(cell, scalars)) || (rampsMayErr_ && missesRamp(cell, scalars)) ||
               ((colorsMayErr_ || colorsMayErrInFlatCells_) && missesColor(cell, scalars)) ||
               missesJump(cell, scalars) || missesIsosurface(cell, scalars) ||
               (use_.scalarsShow && missesBeginning(cell, scalars));
    }

private:
    double largestDepthError() const { return use_.addsUp ? largestSummedError : largestHiddenError; }

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

    /// How much the colour changes per unit of the scalar between two of its nodes, and at a jump none.
    double colorSlopeFrom(std::size_t i) const {
        const auto &a = function_.color[i], &b = function_.color[i + 1];
        return b.scalar > a.scalar ? largestOf(b.color - a.color) / (b.scalar - a.scalar) : 0.0;
    }
    static double largestOf(const glm::dvec3& change) {
        return std::max({std::abs(change.x), std::abs(change.y), std::abs(change.z)});
    }

    struct Jump {
        double scalar, extinction, color;  ///< by how much either jumps
    };
    static std::vector<Jump> jumpsOf(const preint::TransferFunction& function) {
        std::vector<Jump> jumps;
        for (std::size_t i = 0; i + 1 < function.extinction.size(); ++i) {
            const auto &a = function.extinction[i], &b = function.extinction[i + 1];
            if (a.scalar == b.scalar) jumps.push_back({a.scalar, std::abs(b.extinction - a.extinction), 0.0});
        }
        for (std::size_t i = 0; i + 1 < function.color.size(); ++i) {
            const auto &a = function.color[i], &b = function.color[i + 1];
            if (a.scalar == b.scalar) jumps.push_back({a.scalar, 0.0, largestOf(b.color - a.color)});
        }
        return jumps;
    }

    /// By how much the scalar errs in a flat cell, whose planes err by so much of its thickness.
    static double flatScalarError(const CellShape& shape, const CellScalars& scalars) {
        return scalars.width() * std::min(1.0, planeError * shape.longestEdge / std::max(shape.leastAltitude, 1e-300));
    }

    /// The path along which a cell's light adds up: a length, or a variation of the scalar.
    double pathIn(const CellShape& shape, const CellScalars& scalars) const {
        return (standard_ ? shape.longestEdge : scalars.width()) * oblique_;
    }
    /// What an error of the colour counts for in a cell of that depth.
    double weightOf(double depth) const {
        return use_.scalarsShow ? (depth > 0 ? 1.0 : 0.0) : use_.addsUp ? depth : std::min(depth, 1.0);
    }

    bool missesColor(mesh::CellIndex cell, const CellScalars& scalars) const {
        const double most = extinctionsOf(function_, scalars).most, rounding = scalarError(scalars);
        if (!(most > 0)) return false;
        const CellShape shape = shapeOf(mesh_, cell);
        const double error = rounding + (colorsMayErrInFlatCells_ ? flatScalarError(shape, scalars) : 0.0);
        return colorError(scalars, error) * weightOf(most * pathIn(shape, scalars)) > largestColorError;
    }

    /// What share of the cell's scalars a part of them is.
    static double shareOf(double part, const CellScalars& scalars) {
        return scalars.width() > 0 ? std::clamp(part / scalars.width(), 0.0, 1.0) : 1.0;
    }

    /// The largest error of a cell's colour where its scalars err by `error`.
    double colorError(const CellScalars& scalars, double error) const {
        double largest = 0;
        for (std::size_t i = 0; i + 1 < function_.color.size(); ++i) {
            const double low = function_.color[i].scalar, high = function_.color[i + 1].scalar;
            if (low > scalars.high + error || high < scalars.low - error || !(high > low)) continue;
            const double within = std::min(high, scalars.high) - std::max(low, scalars.low);
            largest =
                std::max(largest, colorSlopeFrom(i) * std::min(error, high - low) * shareOf(within + error, scalars));
        }
        return largest;
    }

    /// Whether floats may put a noticeable part of the cell on the other side of a jump. Equal numbers stay equal.
    bool missesJump(mesh::CellIndex cell, const CellScalars& scalars) const {
        const double error = scalarError(scalars);
        for (const Jump& jump : jumps_) {
            if (jump.scalar < scalars.low - error || jump.scalar > scalars.high + error) continue;
            if (scalars.width() == 0 && jump.scalar == scalars.low) continue;
            const double share = scalars.width() > error ? error / scalars.width() : 1.0;
            if (std::max(share * jump.color, share) <= 1e-6) continue;
            const CellShape shape = shapeOf(mesh_, cell);
            const auto [least, most] = extinctionsOf(function_, scalars);
            const double path = pathIn(shape, scalars);
            const double behind = use_.addsUp ? 1.0 : std::exp(-std::min(least * path, 700.0));
            const double depth = jump.extinction * path * share;
            if (std::min(depth, use_.addsUp ? depth : 1.0) * behind > largestColorError ||
                share * jump.color * weightOf(std::max(most, jump.extinction) * path) > largestColorError)
                return true;
        }
        return false;
    }

    /// Whether floats do not tell well enough where in the cell extinction begins or ends: for distances to there, how
    /// far it is; where anything counts for something, whether there is any. A part of the cell's scalars that is lost
    /// in their rounding may be lost by all cells about it, and with it what a ray meets first.
    bool missesBeginning(mesh::CellIndex cell, const CellScalars& scalars) const {
        const double error = scalarError(scalars);
        const auto meets = [&](double scalar) {
            return scalar >= scalars.low - error && scalar <= scalars.high + error &&
                   !(scalars.width() == 0 && scalar == scalars.low);  // equal numbers stay equal
        };
        if (std::none_of(support_.begin(), support_.end(),
                         [&](const ShownScalars& shown) { return meets(shown.low) || meets(shown.high); }))
            return false;
        for (const ShownScalars& shown : support_) {
            const double part = std::min(shown.high, scalars.high) - std::max(shown.low, scalars.low);
            if (part > 0 && part <= mostLostErrors * error) return true;
        }
        const double share = scalars.width() > error ? error / scalars.width() : 1.0;
        if (use_.gathers != FloatUse::Gathers::Crossings) return share > largestHiddenShare;
        return share * shapeOf(mesh_, cell).longestEdge > largestColorError * mesh_.bounds.diagonal();
    }

    bool missesExtreme(mesh::CellIndex cell, const CellScalars& scalars) const {
        const CellShape shape = shapeOf(mesh_, cell);
        return colorError(scalars, flatScalarError(shape, scalars)) > largestColorError;
    }

    /// Lengths err by what planes do. Of a mesh that is thin everywhere that is much of the whole way through it.
    bool missesMean(mesh::CellIndex cell) const {
        return shapeOf(mesh_, cell).longestEdge * planeError * obliqueness > largestColorError * thickness_;
    }

    /// By how much the cell's scalars err on their way to a ray.
    double scalarError(const CellScalars& scalars) const {
        return scalarRounding * std::max(scalars.high - mesh_.scalarMin, 0.0) + leastFloat * range_;
    }

    bool missesDepth(mesh::CellIndex cell, const CellScalars& scalars) const {
        const auto [least, most] = extinctionsOf(function_, scalars);
        if (!standard_ && most * std::max(scalars.width(), scalarError(scalars)) <= largestDepthError()) return false;
        const CellShape shape = shapeOf(mesh_, cell);
        const double altitude = std::max(shape.leastAltitude, 1e-300);
        if (standard_) {
            const double lengthError = shape.longestEdge * planeError * obliqueness;
            if (use_.addsUp) return most * oblique_ * lengthError > largestDepthError();
            // what is visible of a segment that is as long as the cell is thick errs as its length does
            return least * altitude <= opaqueDepth &&
                   std::min(most * oblique_, opaqueDepth / altitude) * lengthError > largestDepthError();
        }
        if (use_.addsUp && scalars.width() > 0 &&
            most * std::max(scalarError(scalars), flatScalarError(shape, scalars)) > largestDepthError())
            return true;
        const double depth = least * scalars.width() > opaqueDepth ? 0.0 : most * scalars.width();
        // tables have no digits to spare: the spacing of texels is added to what rounding does
        const double seen = use_.fromTable ? most * scalars.width() : std::min(depth, opaqueDepth);
        if (seen * std::min(1.0, planeError * shape.longestEdge / altitude) > largestDepthError()) return true;
        return !use_.silhouettes &&
               most * scalarError(scalars) * std::exp(-least * scalars.width()) > largestDepthError() &&
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
            const double error = scalarError(scalars);
            if (!(b.scalar > a.scalar) || a.scalar > scalars.high + error || b.scalar < scalars.low - error) continue;
            const double begin = std::clamp(scalars.low, a.scalar, b.scalar),
                         end = std::clamp(scalars.high, a.scalar, b.scalar);
            const auto extinctionAt = [&](double s) {
                const double t = (s - a.scalar) / (b.scalar - a.scalar);
                return (1.0 - t) * a.extinction + t * b.extinction;
            };
            const double least = std::min(extinctionAt(begin), extinctionAt(end)), slope = slopeFrom(i);
            rise = std::max(rise, slope * (end - begin));
            const double foot = use_.addsUp ? std::min(slope * error, std::abs(b.extinction - a.extinction)) * path *
                                                  shareOf(end - begin + error, scalars)
                                            : footError(slope, least, path, scalars);
            if (foot > largestDepthError()) return shows(scalars, shape);
        }
        return inTable_ && rise * shape.longestEdge > largestTableRise && shows(scalars, shape);
    }

    /// The error of transmittance on a ramp whose extinction is at least `least` in the cell.
    double footError(double slope, double least, double path, const CellScalars& scalars) const {
        const double error = scalarError(scalars), deepest = slope * path * scalars.width();
        if (slope * error <= std::exp(1.0) * largestDepthError() * least) return 0.0;
        return slope * path * error * (deepest > 1.0 ? std::exp(-0.5) / std::sqrt(deepest) : 1.0);
    }

    /// Whether errors within the cell do: it is not opaque through and through.
    bool shows(const CellScalars& scalars, const CellShape& shape) const {
        const double path = standard_ ? shape.leastAltitude : scalars.width();
        return use_.addsUp || extinctionsOf(function_, scalars).least * path <= opaqueDepth;
    }

    /// Whether an isosurface may be met twice or never, since both sides of a face must agree about its scalar.
    bool missesIsosurface(mesh::CellIndex cell, const CellScalars& scalars) const {
        bool crossed = false;
        for (const auto& surface : function_.isosurfaces) {
            if (!(surface.opacity > 0)) continue;
            crossed =
                crossed || (surface.value >= scalars.low && surface.value - floatPerturbation * range_ <= scalars.high);
            if (perturbed(scalars, surface.value)) return true;
        }
        if (!crossed && !use_.scalarsShow) return false;
        const CellShape shape = shapeOf(mesh_, cell);
        return planeError * shape.longestEdge > largestScalarError * shape.leastAltitude ||
               (crossed && missesLevelFace(cell, flatScalarError(shape, scalars)));
    }

    /// Whether an isosurface lies within the scalar's error of a face that is level, or nearly so: then its two cells
    /// do not agree in many pixels on which of them it crosses. Isosurfaces stand lower in float by what is no matter.
    bool missesLevelFace(mesh::CellIndex cell, double error) const {
        const double perturbation = floatPerturbation * range_;
        if (error <= perturbation) return false;
        for (const auto& face : mesh::faceVertices) {
            const double a = mesh_.scalarAt(cell, face[0]), b = mesh_.scalarAt(cell, face[1]),
                         c = mesh_.scalarAt(cell, face[2]);
            const double low = std::min({a, b, c}), high = std::max({a, b, c});
            if (high - low > levelFace * error) continue;
            for (const auto& surface : function_.isosurfaces)
                if (surface.opacity > 0 && surface.value >= low - error && surface.value <= high + error + perturbation)
                    return true;
        }
        return false;
    }

    /// Whether scalars that hardly differ lie between the places of an isosurface in double and in float, or the latter
    /// within rounding.
    bool perturbed(const CellScalars& scalars, double value) const {
        const double farthest = (floatPerturbation + scalarRounding) * range_;
        return scalars.width() * largestPerturbation < farthest && scalars.low < value - doublePerturbation * range_ &&
               scalars.high >= value - farthest;
    }

    const mesh::ScalarMesh& mesh_;
    const preint::TransferFunction& function_;
    const bool standard_;
    const FloatUse use_;
    const bool inTable_;
    const double range_, oblique_;
    const double thickness_;  ///< the mesh's volume over its largest extent squared
    std::vector<Jump> jumps_;
    std::vector<ShownScalars> support_;
    bool depthMayErr_ = false, rampsMayErr_ = false, colorsMayErr_ = false, colorsMayErrInFlatCells_ = false;
};

}  // namespace

std::vector<mesh::CellIndex> cellsBeyondFloat(const mesh::ScalarMesh& mesh, const preint::TransferFunction& function,
                                              preint::Integral integral, const FloatUse& use) {
    const FloatLimits limits(mesh, function, integral, use);
    if (!limits.anything()) return {};
    auto all = gathered<mesh::CellIndex>(mesh.cells.size(), [&](std::size_t i, auto& found) {
        if (limits.beyond(static_cast<mesh::CellIndex>(i))) found.push_back(static_cast<mesh::CellIndex>(i));
    });
    std::sort(all.begin(), all.end());
    return all;
}

}  // namespace tetralux::projection
