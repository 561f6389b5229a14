// SPDX-License-Identifier: Apache-2.0
#include <projection/repair/isosurface_outlines.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <mesh/tet/adjacency.h>
#include <projection/cells/cell_setup.h>
#include <projection/core/gathered.h>
#include <projection/core/perturbed_isosurfaces.h>
#include <projection/repair/near_line.h>

namespace tetralux::projection {

namespace {

/// An isosurface that is fainter may be missed in a pixel: the picture's error stays below this.
constexpr double faintest = 1e-3;

/// The scalar of 0 … 1 at a face errs by two roundings of float, and by what its plane does: this share of the cell's
/// longest edge (float_limits.h). Where that makes more than `mostRounding`, every pixel of the cell is uncertain
/// already.
constexpr double scalarRounding = 0x1p-23, planeRounding = 4e-7, mostRounding = 1e-3;

/// Pixels; where the scalar hardly changes over a face, a line is no wider than this.
constexpr double leastWidth = 1e-6, mostWidth = 0.5;

/// Distances from a line along an image axis are so much longer at most.
constexpr double alongAxis = std::numbers::sqrt2;

double longestEdge(const mesh::ScalarMesh& mesh, mesh::CellIndex cell) {
    double longest = 0;
    for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t j = i + 1; j < 4; ++j)
            longest = std::max(longest,
                               glm::distance(mesh.positions[mesh.cells[cell][i]], mesh.positions[mesh.cells[cell][j]]));
    return longest;
}

/// A face before the camera: pixels from the axis times depth (orthographic: pixels), and depth.
struct FaceCorners {
    std::array<glm::dvec3, 3> at;
    std::array<double, 3> scalars;

    /// Where the scalar is `value`, or what of the face's it is nearest to. They are not all the same.
    std::array<glm::dvec3, 2> lineAt(double value) const {
        const auto [low, high] = std::minmax({scalars[0], scalars[1], scalars[2]});
        const double inside = std::clamp(value, std::nextafter(low, high), high);
        std::array<glm::dvec3, 2> ends;
        std::size_t count = 0;
        for (std::size_t i = 0; i < 3; ++i) {
            const std::size_t j = (i + 1) % 3;
            if ((scalars[i] < inside) != (scalars[j] < inside))
                ends[count++] = glm::mix(at[i], at[j], (inside - scalars[i]) / (scalars[j] - scalars[i]));
        }
        return ends;
    }
};

/// A line's place in the image.
struct SeenLine {
    std::array<glm::dvec2, 2> ends;

    double distance(const glm::dvec2& p) const {
        const glm::dvec2 along = ends[1] - ends[0], from = p - ends[0];
        const double length = glm::length(along);
        return length > 0 ? std::abs(along.x * from.y - along.y * from.x) / length : glm::length(from);
    }
};

/// False where nothing of it is before the eye. What lies behind is cut off so near to the eye's plane that the rest
/// leaves any image.
bool see(std::array<glm::dvec3, 2> ends, const CameraFrame& frame, SeenLine& seen) {
    constexpr double nearPlane = 1e-6;
    const double least = nearPlane * std::max(ends[0].z, ends[1].z);
    if (!(least > 0)) return false;
    for (std::size_t i = 0; i < 2; ++i)
        if (ends[i].z < least) {
            ends[i] = glm::mix(ends[i], ends[1 - i], (least - ends[i].z) / (ends[1 - i].z - ends[i].z));
            ends[i].z = least;
        }
    for (std::size_t i = 0; i < 2; ++i)
        seen.ends[i] = frame.centre + glm::dvec2(ends[i]) / (frame.orthographic ? 1.0 : ends[i].z);
    return true;
}

}  // namespace

IsosurfaceOutlines::IsosurfaceOutlines(const Scene& scene) : mesh_(scene.mesh), units_(sceneUnits(*scene.mesh)) {
    const bool stronger = scene.settings.shading.silhouette;  // near folds, where lines are
    for (const preint::Isosurface& surface : scene.transferFunction.isosurfaces)
        if (surface.opacity > faintest || (stronger && surface.opacity > 0)) values_.push_back(surface.value);
    if (values_.empty() || mesh_->association == mesh::Association::Cell) return;
    perturbation_ = floatPerturbation * units_.scalarScale;
    const auto crossed = gathered<mesh::CellIndex>(mesh_->cells.size(), [&](std::size_t cell, auto& found) {
        const mesh::Tetrahedron& c = mesh_->cells[cell];
        const auto& s = mesh_->scalars;
        const auto [low, high] = std::minmax({s[c[0]], s[c[1]], s[c[2]], s[c[3]]});
        if (holdsValue(low, high)) found.push_back(static_cast<mesh::CellIndex>(cell));
    });
    cells_.resize(crossed.size());
    tbb::parallel_for(std::size_t{0}, crossed.size(), [&](std::size_t i) {
        const auto corner = mesh_->cells[crossed[i]][0];
        cells_[i] = {mesh::cellGradient(*mesh_, crossed[i]), mesh_->positions[corner], mesh_->scalars[corner],
                     roundingOf(crossed[i]), crossed[i]};
    });
    addLines(crossed);
}

bool IsosurfaceOutlines::holdsValue(double low, double high) const {
    const auto first = std::upper_bound(values_.begin(), values_.end(), low);
    return first != values_.end() && *first <= high;
}

double IsosurfaceOutlines::roundingOf(mesh::CellIndex cell) const {
    const double plane =
        planeRounding * unitGradient(*mesh_, units_, cell).magnitude * longestEdge(*mesh_, cell) / units_.length;
    return (scalarRounding + std::min(plane, mostRounding)) * units_.scalarScale;
}

/// A face's own scalars hold the value, so both of its cells are among `crossed`.
void IsosurfaceOutlines::addLines(const std::vector<mesh::CellIndex>& crossed) {
    std::vector<mesh::Tetrahedron> cells;
    cells.reserve(crossed.size());
    for (mesh::CellIndex cell : crossed) cells.push_back(mesh_->cells[cell]);
    const mesh::Adjacency adjacency = mesh::buildAdjacency(cells, mesh_->positions.size());
    lines_ = gathered<Line>(cells.size(), [&](std::size_t cell, auto& found) {
        const auto front = static_cast<std::uint32_t>(cell);
        for (std::uint32_t face = 0; face < 4; ++face) {
            const mesh::CellIndex other = adjacency.neighbours[front][face];
            const bool boundary = other == mesh::Adjacency::noNeighbour;
            if (!boundary && other < front) continue;
            std::array<double, 3> s;
            for (std::size_t i = 0; i < 3; ++i)
                s[i] = mesh_->scalars[cells[front][static_cast<std::size_t>(mesh::faceVertices[face][i])]];
            const auto [low, high] = std::minmax({s[0], s[1], s[2]});
            for (auto value = std::upper_bound(values_.begin(), values_.end(), low);
                 value != values_.end() && *value <= high; ++value)
                found.push_back({front, boundary ? front : other,
                                 static_cast<std::uint32_t>(value - values_.begin()) & 0x3fffffffu, face & 3u});
        }
    });
}

std::vector<std::uint32_t> IsosurfaceOutlines::pixels(const CameraFrame& frame) const {
    // the scalar at the eye, were the cell to reach it, or how it rises along all rays: an isosurface faces the eye
    // where this is below its value, or falls
    std::vector<double> eyeScalars(cells_.size());
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, cells_.size(), 4096), [&](const auto& range) {
        for (std::size_t i = range.begin(); i != range.end(); ++i) {
            const Cell& cell = cells_[i];
            eyeScalars[i] = frame.orthographic ? glm::dot(cell.gradient, frame.forward)
                                               : cell.scalar + glm::dot(cell.gradient, frame.eye - cell.corner);
        }
    });
    const CameraAxes axes = cameraAxes(frame, units_);
    return gathered<std::uint32_t>(lines_.size(), [&](std::size_t i, auto& found) {
        if (outlines(lines_[i], eyeScalars, frame.orthographic)) addNear(lines_[i], frame, axes, found);
    });
}

void IsosurfaceOutlines::addNear(const Line& line, const CameraFrame& frame, const CameraAxes& axes,
                                 std::vector<std::uint32_t>& pixels) const {
    const mesh::Tetrahedron& cell = mesh_->cells[cells_[line.front].index];
    FaceCorners face;
    for (std::size_t i = 0; i < 3; ++i) {
        const mesh::PointIndex corner = cell[static_cast<std::size_t>(mesh::faceVertices[line.face][i])];
        const glm::dvec3 p = mesh_->positions[corner] - frame.eye;
        face.at[i] = {glm::dot(p, axes.right), glm::dot(p, axes.down), glm::dot(p, axes.forward)};
        face.scalars[i] = mesh_->scalars[corner];
    }
    const double value = values_[line.value],
                 rounding = std::max(cells_[line.front].rounding, cells_[line.behind].rounding);
    SeenLine middle, beside;
    if (!see(face.lineAt(value - 0.5 * perturbation_), frame, middle)) return;
    double width = 0;
    for (double limit :
         {value - perturbation_ - rounding, value + rounding})  // the isosurface stands up to perturbation_ lower
        if (see(face.lineAt(limit), frame, beside))
            width = std::max({width, middle.distance(beside.ends[0]), middle.distance(beside.ends[1])});
    addNearLine(middle.ends[0], middle.ends[1], {0.0, std::min(alongAxis * width + leastWidth, mostWidth)}, frame,
                pixels);
}

}  // namespace tetralux::projection
