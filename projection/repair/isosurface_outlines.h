// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include <glm/vec3.hpp>

#include <mesh/tet/tet_mesh.h>
#include <projection/cells/camera_points.h>
#include <projection/core/camera.h>
#include <projection/core/scene.h>
#include <projection/core/scene_units.h>

namespace tetralux::projection {

/// Where the number of times that a ray meets an isosurface changes from one side of a line in the image to the other:
/// on faces where the surface ends (the mesh's boundary) or turns back (it faces the eye in one of the two cells and
/// turns away in the other). A fast engine, whose scalars are floats and whose isosurfaces stand lower by
/// floatPerturbation (isosurface_perturbation.h), takes a ray that meets such a face within that of the isosurface's
/// value for one of the other side, and a pixel may miss an opaque surface.
class IsosurfaceOutlines {
public:
    explicit IsosurfaceOutlines(const Scene& scene);

    /// Pixels (y·width + x, in no order, some twice) whose centre is that near to such a line.
    std::vector<std::uint32_t> pixels(const CameraFrame& frame) const;

private:
    /// A cell with an isosurface. Its scalar at p is scalar + gradient·(p − corner); the scalar of a ray that leaves it
    /// errs by up to `rounding`.
    struct Cell {
        glm::dvec3 gradient, corner;
        double scalar, rounding;
        mesh::CellIndex index;
    };

    /// An isosurface's line in a face: which value, and the cells on both sides; `behind` is `front` on the boundary.
    struct Line {
        std::uint32_t front, behind;
        std::uint32_t value : 30, face : 2;  ///< the face of `front`
    };

    bool holdsValue(double low, double high) const;
    double roundingOf(mesh::CellIndex cell) const;
    void addLines(const std::vector<mesh::CellIndex>& crossed);
    /// Whether the isosurface ends or turns back here.
    bool outlines(const Line& line, const std::vector<double>& eyeScalars, bool orthographic) const {
        const double turns = orthographic ? 0.0 : values_[line.value];
        return line.front == line.behind || (eyeScalars[line.front] < turns) != (eyeScalars[line.behind] < turns);
    }
    void addNear(const Line& line, const CameraFrame& frame, const CameraAxes& axes,
                 std::vector<std::uint32_t>& pixels) const;

    std::shared_ptr<const mesh::ScalarMesh> mesh_;
    SceneUnits units_;
    std::vector<double> values_;  ///< of isosurfaces that one pixel shows, ascending
    double perturbation_ = 0;     ///< floatPerturbation in the field's units
    std::vector<Cell> cells_;
    std::vector<Line> lines_;
};

}  // namespace tetralux::projection
