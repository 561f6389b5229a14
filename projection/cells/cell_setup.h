// SPDX-License-Identifier: Apache-2.0
/// \file
/// Projected cells: what a fast engine needs to cut any pixel's ray by one tetrahedron, in 24 floats.
/// Derivation and use: projection/cells/cell_interval.glsl.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <mesh/tet/tet_mesh.h>
#include <projection/cells/camera_points.h>
#include <projection/core/camera.h>
#include <projection/core/scene_units.h>

namespace tetralux::projection {

/// One projected cell. Std430 layout of six vec4; the shader's struct mirrors it. The reference point c is the
/// centroid, or for cells that reach behind the eye a point of the visible rectangle at half their largest depth.
struct CellRecord {
    float plane[4][3];           ///< inverseDepth of face k = plane[k][0] + plane[k][1]·dx + plane[k][2]·dy
    float frontMask;             ///< Σ 2^k over faces that bound inverseDepth from above (0 … 15), a whole number
    float pixelX, pixelY;        ///< whole pixel nearest to the projection of c
    float fractionX, fractionY;  ///< dx = (x − pixelX) − fractionX, likewise dy
    float scalar;                ///< at c, scene units
    float scalarPerX, scalarPerY, scalarPerInverseDepth;
    float scalarLow, scalarHigh;  ///< over the cell's vertices, scene units
    float scale;  ///< z_c, scene lengths, less CameraFrame::depthOrigin; orthographic: z_c may be negative, L = |z_c|
};
static_assert(sizeof(CellRecord) == 24 * sizeof(float));

/// Largest inverseDepth, that of the eye: where no face bounds inverseDepth from above the eye is in the cell.
/// Orthographic views start at the eye's plane instead, where inverseDepth is the sign of `scale`: bound inverseDepth
/// by that.
inline constexpr float inverseDepthAtEye = 1e30f;

/// The gradient of one cell for silhouettes and light: unit normal g/|g| (zero if g = 0) in world space, and |g| in
/// scene scalars per scene length.
struct CellGradient {
    float normal[3];
    float magnitude;
};

CellGradient unitGradient(const mesh::ScalarMesh& mesh, const SceneUnits& units, mesh::CellIndex cell);

/// Pixel rectangle [x0, x1) × [y0, y1) that holds a cell's projection, within the image.
struct PixelRect {
    int x0, y0, x1, y1;
    bool empty() const { return x0 >= x1 || y0 >= y1; }
};

/// Why a cell is not drawn; `skipReasonName` gives the report's text.
enum class SkipReason { None, OutsideView, NoPixelCentre, Invisible };
const char* skipReasonName(SkipReason reason);

/// The pixels whose samples a cell with these corners may cover (conservative by rounding only); OutsideView or
/// NoPixelCentre when there are none. A cell that reaches behind the eye's plane covers the rectangle of its part in
/// front.
SkipReason coveredPixels(const std::array<glm::dvec3, 4>& corners, const CameraFrame& frame, PixelRect& rect);

/// Projects cells for one camera.
class CellProjector {
public:
    CellProjector(const mesh::ScalarMesh& mesh, const SceneUnits& units, const CameraFrame& frame);

    /// With points that projectPoints made for this frame; they stay the caller's.
    CellProjector(const mesh::ScalarMesh& mesh, const SceneUnits& units, const CameraFrame& frame,
                  std::span<const CameraPoint> points);

    CellProjector(const CellProjector&) = delete;
    CellProjector& operator=(const CellProjector&) = delete;

    const CameraFrame& frame() const { return frame_; }
    std::span<const CameraPoint> points() const { return points_; }

    /// coveredPixels of a cell.
    SkipReason bounds(mesh::CellIndex cell, PixelRect& rect) const;

    /// The record of a cell that `bounds` does not skip.
    CellRecord record(mesh::CellIndex cell) const;

    /// The cell's corners before the camera (CameraPoint).
    std::array<glm::dvec3, 4> cameraCorners(mesh::CellIndex cell) const;

    /// On which side of a face's plane the eye is: positive on the inner one, 0 within the plane (orthographic: the
    /// face's extent along the view). Both cells of a face get the same number with opposite signs.
    double eyeSide(mesh::CellIndex cell, int face) const;

    /// The same of all four faces, at once.
    std::array<double, 4> eyeSides(mesh::CellIndex cell) const;

    /// True when a face of the cell shows its outside to the eye (perspective: eye on the outer side of its plane).
    /// Both cells of a face give opposite answers.
    bool faceIsFront(mesh::CellIndex cell, int face) const { return eyeSide(cell, face) < 0; }

    /// Barycentric coordinates λ_k of the eye in the cell (orthographic: rates of λ_k towards the eye, per mesh
    /// length), never quite 0: times the distance from plane k of the record they give λ_k.
    std::array<double, 4> eyeCoordinates(mesh::CellIndex cell) const;

    CellGradient gradient(mesh::CellIndex cell) const { return unitGradient(mesh_, units_, cell); }

private:
    const mesh::ScalarMesh& mesh_;
    SceneUnits units_;
    CameraFrame frame_;
    std::vector<CameraPoint> ownPoints_;
    std::span<const CameraPoint> points_;
};

}  // namespace tetralux::projection
