// SPDX-License-Identifier: Apache-2.0
/// \file
/// Internal: how much light comes through the volume along a line.
#pragma once

#include <algorithm>
#include <memory>
#include <span>
#include <vector>

#include <glm/vec2.hpp>

#include <mesh/tet/cell_tree.h>
#include <mesh/tet/triangle_tree.h>
#include <preint/exact_integral.h>
#include <projection/core/clip_region.h>
#include <projection/core/scene.h>

namespace tetralux::projection {

/// From a place to a light: x = origin + t·direction, 0 ≤ t ≤ end.
struct ShadowLine {
    glm::dvec3 origin;
    glm::dvec3 direction;  ///< unit; no component is 0, so that boxes can be cut (mesh/tet/box_tree.h)
    double end;
};

/// Isosurfaces in ascending order, [from, to).
struct SurfaceRange {
    std::size_t from = 0, to = 0;
    bool empty() const { return from >= to; }
    bool operator==(const SurfaceRange&) const = default;
};

/// Where a line begins.
struct ShadowStart {
    /// The line begins here for opaque surfaces: what a place stands on does not shade it.
    glm::dvec3 place;
    /// And here for the volume: beside `place`, within a cell, so that the line runs in no face and no edge of a grid,
    /// and within the volume where `place` is on its boundary.
    glm::dvec3 within;
    /// Behind these, as the light comes, it begins: the line's first crossing of each does not count.
    SurfaceRange passed = {};
};

/// Exact along lines: every cell's part by the integral of the picture's mode, isosurfaces and opaque surfaces
/// included, silhouettes not, nor what the scene's clip regions cut off. Holds the scene's mesh by reference.
class ShadowRays {
public:
    explicit ShadowRays(const Scene& scene);

    double transmittance(const ShadowStart& start, const ShadowLine& line) const;

    /// How many isosurfaces have a value that is not above the scalar: by definition s = v is not below v.
    std::size_t level(double scalar) const;

    /// The isosurfaces that pass through a cell; those of the two cells of a face are in one of them if on the face.
    SurfaceRange surfacesIn(mesh::CellIndex cell) const;

    bool hasSurfaces() const { return !surfaces_.empty(); }

    /// Where a line from `place` begins within the volume: at `place` if that is in no cell.
    glm::dvec3 within(const glm::dvec3& place) const;
    /// The same in a given cell.
    glm::dvec3 within(const glm::dvec3& place, mesh::CellIndex cell) const;
    /// Where one from a vertex begins: in the largest of its cells, if there is a choice one in which it begins on the
    /// vertex's side of the isosurfaces, which may pass through the vertex.
    glm::dvec3 within(mesh::PointIndex vertex, std::span<const mesh::CellIndex> around) const;

private:
    double shareOfWay(const glm::dvec3& place, mesh::CellIndex cell, glm::dvec3& way) const;

    /// The part of a line in one cell and the scalars at its ends.
    struct Part {
        double begin = 0, end = 0, front = 0, back = 0;

        /// Whether the scalar is `value` between two distances. Where less than rounding of it is left: in the middle.
        bool contains(double value, const glm::dvec2& distances) const {
            const double step = back - front, share = step != 0 ? std::clamp((value - front) / step, 0.0, 1.0) : 0.5;
            const double at = begin + share * (end - begin);
            return at >= distances.x && at <= distances.y;
        }
    };
    Part partIn(mesh::CellIndex cell, const ShadowLine& line) const;
    glm::dvec2 shownOf(const ShadowLine& line) const;
    bool hidden(const ShadowStart& start, const ShadowLine& line) const;
    double smoothDepth(Part part, const glm::dvec2& shown) const;
    double surfaceDepth(const ShadowStart& start, std::vector<Part>& parts, const glm::dvec2& shown) const;

    const mesh::ScalarMesh& mesh_;
    const mesh::CellTree tree_;
    const std::vector<mesh::TriangleTree::Corners> triangles_;
    const mesh::TriangleTree triangleTree_;
    const preint::ExactIntegral exact_;
    const bool scaleInvariant_;
    std::vector<std::shared_ptr<const ClipRegion>> regions_;
    std::vector<double> surfaces_;       // values of isosurfaces, ascending; none where no segment can cross them
    std::vector<double> surfaceDepths_;  // −ln(1 − opacity)
};

}  // namespace tetralux::projection
