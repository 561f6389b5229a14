// SPDX-License-Identifier: Apache-2.0
#include <projection/order/float_limits.h>

#include <algorithm>
#include <cmath>

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <glm/geometric.hpp>

#include <projection/transfer_support.h>

namespace tetralux::projection {

namespace {

constexpr double largestDepthError = 1e-3;
constexpr double planeError = 1e-7;          // of the longest edge
constexpr double obliqueness = 3.0;          // of the error of a length over that of a plane
constexpr double largestScalarError = 3e-4;  // of a cell's range, where an isosurface may be crossed
constexpr double scalarRounding = 6e-8;      // of the field's range: half a float's step at 1
constexpr double largestTableRise = 5e2;     // of the depth within a cell; chosen by trial: 3e3 left rmse of 1e-3
constexpr double opaqueDepth = 20.0;         // exp(−20) is below float's step: more or less depth does not show

double largestExtinction(const preint::TransferFunction& function, double low, double high) {
    double largest = std::max(function.extinctionAt(low), function.extinctionAt(high));
    for (const auto& node : function.extinction)
        if (node.scalar >= low && node.scalar <= high) largest = std::max(largest, node.extinction);
    return largest;
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

/// Whether scalars on the cell's faces err by more than shows, where they do: everywhere, or where an isosurface may be
/// met twice or not at all, since both sides of a face must agree about its scalar.
bool mayMissScalar(const mesh::ScalarMesh& mesh, mesh::CellIndex cell, const preint::TransferFunction& function,
                   bool everywhere) {
    const glm::dvec2 scalars = scalarRange(mesh, cell);
    const double low = scalars.x, high = scalars.y;
    const bool crossed = std::any_of(
        function.isosurfaces.begin(), function.isosurfaces.end(),
        [&](const auto& surface) { return surface.opacity > 0 && surface.value >= low && surface.value <= high; });
    if (!crossed && !everywhere) return false;
    const CellShape shape = shapeOf(mesh, cell);
    return planeError * shape.longestEdge > largestScalarError * shape.leastAltitude;
}

double depthError(const mesh::ScalarMesh& mesh, mesh::CellIndex cell, const preint::TransferFunction& function,
                  preint::Integral integral, double strongest) {
    const CellShape shape = shapeOf(mesh, cell);
    const double longest = shape.longestEdge, altitude = shape.leastAltitude;  // clang 14 captures no bindings
    const glm::dvec2 scalars = scalarRange(mesh, cell);
    const double low = scalars.x, high = scalars.y;
    auto error = [&](double extinction) {
        if (integral == preint::Integral::Standard)
            return extinction * altitude > opaqueDepth ? 0.0 : extinction * longest * planeError * obliqueness;
        return extinction * (high - low) * std::min(1.0, planeError * longest / std::max(altitude, 1e-300));
    };
    if (!(error(strongest) > largestDepthError) && integral == preint::Integral::ScaleInvariant) return 0.0;
    return error(largestExtinction(function, low, high));
}

double leastExtinction(const preint::TransferFunction& function, double low, double high) {
    double least = std::min(function.extinctionAt(low), function.extinctionAt(high));
    for (const auto& node : function.extinction)
        if (node.scalar >= low && node.scalar <= high) least = std::min(least, node.extinction);
    return least;
}

/// The steepest ramp of extinction among the scalars of a cell: its rise there, and its slope by scalar times the share
/// of the cell's scalars that lie on it.
struct Ramp {
    double rise = 0, slope = 0;
};

Ramp steepestRamp(const preint::TransferFunction& function, double low, double high) {
    Ramp steepest;
    for (std::size_t i = 0; i + 1 < function.extinction.size(); ++i) {
        const auto &a = function.extinction[i], &b = function.extinction[i + 1];
        if (!(b.scalar > a.scalar) || a.scalar > high || b.scalar < low) continue;  // a jump has no ramp
        const double slope = std::abs(b.extinction - a.extinction) / (b.scalar - a.scalar);
        const double overlap = std::min(b.scalar, high) - std::max(a.scalar, low);
        steepest.rise = std::max(steepest.rise, slope * overlap);
        steepest.slope = std::max(steepest.slope, high > low ? slope * (overlap / (high - low)) : slope);
    }
    return steepest;
}

/// Whether a ramp is so steep that rounding of the scalar, or the spacing of a table's texels, shows in depth: not
/// where all of the cell is opaque anyway.
bool mayMissRamp(const mesh::ScalarMesh& mesh, mesh::CellIndex cell, const preint::TransferFunction& function,
                 bool fromTable) {
    const glm::dvec2 scalars = scalarRange(mesh, cell);
    const double low = scalars.x, high = scalars.y;
    const Ramp ramp = steepestRamp(function, low, high);
    const CellShape shape = shapeOf(mesh, cell);
    const double error = ramp.slope * (mesh.scalarMax - mesh.scalarMin) * scalarRounding * shape.longestEdge;
    if (!(error > largestDepthError) && !(fromTable && ramp.rise * shape.longestEdge > largestTableRise)) return false;
    return !(leastExtinction(function, low, high) * shape.leastAltitude > opaqueDepth);
}

/// Whether no cell can miss a ramp, since none is longer than the mesh nor ranges wider: most scenes.
bool holdsRamps(const mesh::ScalarMesh& mesh, const preint::TransferFunction& function, double strongest,
                bool fromTable) {
    const double diagonal = mesh.bounds.diagonal(), range = mesh.scalarMax - mesh.scalarMin;
    double slope = 0;
    for (std::size_t i = 0; i + 1 < function.extinction.size(); ++i) {
        const auto &a = function.extinction[i], &b = function.extinction[i + 1];
        if (b.scalar > a.scalar) slope = std::max(slope, std::abs(b.extinction - a.extinction) / (b.scalar - a.scalar));
    }
    return !(slope * range * scalarRounding * diagonal > largestDepthError) &&
           !(fromTable && strongest * diagonal > largestTableRise);
}

}  // namespace

std::vector<mesh::CellIndex> cellsBeyondFloat(const mesh::ScalarMesh& mesh, const preint::TransferFunction& function,
                                              preint::Integral integral, bool scalarsShow, bool fromTable) {
    double strongest = 0;
    for (const auto& node : function.extinction) strongest = std::max(strongest, node.extinction);
    // no cell is longer than the mesh or ranges wider: most scenes end here
    const double most = integral == preint::Integral::Standard
                            ? strongest * mesh.bounds.diagonal() * planeError * obliqueness
                            : strongest * (mesh.scalarMax - mesh.scalarMin);
    const bool ramps = integral == preint::Integral::Standard && !holdsRamps(mesh, function, strongest, fromTable);
    if (!(most > largestDepthError) && !ramps && function.isosurfaces.empty() && !scalarsShow) return {};

    tbb::enumerable_thread_specific<std::vector<mesh::CellIndex>> found;
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, mesh.cells.size(), 4096), [&](const auto& range) {
        auto& mine = found.local();
        for (std::size_t i = range.begin(); i != range.end(); ++i) {
            const auto cell = static_cast<mesh::CellIndex>(i);
            if ((most > largestDepthError &&
                 depthError(mesh, cell, function, integral, strongest) > largestDepthError) ||
                (ramps && mayMissRamp(mesh, cell, function, fromTable)) ||
                mayMissScalar(mesh, cell, function, scalarsShow))
                mine.push_back(cell);
        }
    });
    std::vector<mesh::CellIndex> all;
    for (const auto& part : found) all.insert(all.end(), part.begin(), part.end());
    std::sort(all.begin(), all.end());
    return all;
}

}  // namespace tetralux::projection
