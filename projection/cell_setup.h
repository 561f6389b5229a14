// SPDX-License-Identifier: Apache-2.0
/// \file
/// Projected cells: what a fast engine needs to cut any pixel's ray by one tetrahedron, in 24 floats.
/// Derivation and use: projection/cell_interval.glsl.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include <glm/vec2.hpp>

#include <mesh/tet_mesh.h>
#include <preint/transfer_function.h>
#include <projection/camera.h>
#include <projection/scene.h>

namespace tetralux::projection {

/// Units in which fast engines compute, so that float holds meshes and scalars of any magnitude: scalars become
/// (s − scalarOffset)/scalarScale in [0, 1], lengths are divided by `length` (the mesh's diagonal).
struct SceneUnits {
    double scalarOffset = 0.0, scalarScale = 1.0, length = 1.0;
    double toUnit(double scalar) const { return (scalar - scalarOffset) / scalarScale; }
};
SceneUnits sceneUnits(const mesh::ScalarMesh& mesh);

/// The transfer function in scene units: extinction per scene length (standard) or per unit scalar (scale-invariant).
preint::TransferFunction inSceneUnits(const preint::TransferFunction& function, const SceneUnits& units,
                                      preint::Integral integral);

/// One projected cell. Std430 layout of six vec4; the shader's struct mirrors it. The reference point c is the
/// centroid, or for cells that reach behind the eye a point of the visible rectangle at half their largest depth.
struct CellRecord {
    float plane[4][3];           ///< rho of face k = plane[k][0] + plane[k][1]·dx + plane[k][2]·dy
    float frontMask;             ///< Σ 2^k over faces that bound rho from above (0 … 15), a whole number
    float pixelX, pixelY;        ///< whole pixel nearest to the projection of c
    float fractionX, fractionY;  ///< dx = (x − pixelX) − fractionX, likewise dy
    float scalar;                ///< at c, scene units
    float scalarPerX, scalarPerY, scalarPerRho;
    float scalarLow, scalarHigh;  ///< over the cell's vertices, scene units
    float scale;                  ///< z_c, scene lengths; orthographic: may be negative, L = |scale|
};
static_assert(sizeof(CellRecord) == 24 * sizeof(float));

/// Largest rho, that of the eye: where no face bounds rho from above the eye is in the cell. Orthographic views start
/// at the eye's plane instead, where rho is the sign of `scale`: bound rho by that.
inline constexpr float rhoAtEye = 1e30f;

/// The gradient of one cell for silhouettes and light: unit normal g/|g| (zero if g = 0) in world space, and |g| in
/// scene scalars per scene length.
struct CellGradient {
    float normal[3];
    float magnitude;
};

/// Pixel rectangle [x0, x1) × [y0, y1) that holds a cell's projection, within the image.
struct PixelRect {
    int x0, y0, x1, y1;
    bool empty() const { return x0 >= x1 || y0 >= y1; }
};

/// Why a cell is not drawn; `skipReasonName` gives the report's text.
enum class SkipReason { None, OutsideView, NoPixelCentre, Invisible };
const char* skipReasonName(SkipReason reason);

/// Projects cells for one camera.
class CellProjector {
public:
    CellProjector(const mesh::ScalarMesh& mesh, const SceneUnits& units, const CameraFrame& frame);

    /// The pixels whose centres the cell may cover (conservative by rounding only); OutsideView or NoPixelCentre
    /// when there are none. A cell that reaches behind the eye's plane covers the rectangle of its part in front.
    SkipReason bounds(mesh::CellIndex cell, PixelRect& rect) const;

    /// The record of a cell that `bounds` does not skip, given the rectangle from there.
    CellRecord record(mesh::CellIndex cell, const PixelRect& rect) const;

    /// The cell's projected corners in pixel coordinates when all four lie in front of the eye; nothing otherwise.
    std::optional<std::array<glm::dvec2, 4>> corners(mesh::CellIndex cell) const;

    /// On which side of a face's plane the eye is: positive on the inner one, 0 within the plane (orthographic: the
    /// face's extent along the view). Both cells of a face get the same number with opposite signs.
    double eyeSide(mesh::CellIndex cell, int face) const { return eyeSide(mesh_.cells[cell], face); }

    /// True when a face of the cell shows its outside to the eye (perspective: eye on the outer side of its plane).
    /// Both cells of a face give opposite answers.
    bool faceIsFront(mesh::CellIndex cell, int face) const;

    /// Barycentric coordinates λ_k of the eye in the cell (orthographic: rates of λ_k towards the eye, per mesh
    /// length): what PowerOrder's keys weight the heights by.
    std::array<double, 4> eyeCoordinates(mesh::CellIndex cell) const;

    CellGradient gradient(mesh::CellIndex cell) const;

private:
    struct LinearForms;  // barycentric coordinates as functions of camera space
    LinearForms linearForms(mesh::CellIndex cell) const;
    double eyeSide(const mesh::Tetrahedron& cell, int face) const;
    glm::dvec2 pixelOf(const glm::dvec3& point) const;

    const mesh::ScalarMesh& mesh_;
    SceneUnits units_;
    CameraFrame frame_;
    /// Per mesh point, relative to the eye: x and y in pixels times depth (pixels when orthographic), z the depth. The
    /// ray of pixel (x, y) is z·(x − centre.x, y − centre.y, 1), or (x − centre.x, y − centre.y, z).
    std::vector<glm::dvec3> cameraPoints_;
};

}  // namespace tetralux::projection
