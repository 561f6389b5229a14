// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <mesh/tet/tet_mesh.h>

namespace tetralux::projection {

/// A right-handed pinhole or orthographic camera; lengths in mesh units.
struct Camera {
    glm::dvec3 eye{0, 0, 1}, target{0, 0, 0}, up{0, 1, 0};
    double fovDegrees = 30.0;         ///< vertical; not used when orthographic
    double orthographicHeight = 0.0;  ///< > 0: orthographic, this many mesh units over the image's height
    int width = 512, height = 512;    ///< pixels
    /// Where the picture's middle lies beside the optical axis: half widths to the right, half heights up.
    glm::dvec2 windowCentre{0};
    /// Of a larger picture, which part this is: its left upper pixel there, and the size of the whole; 0: all of it.
    glm::ivec2 tile{0}, whole{0};
    double aspect = 0.0;  ///< the (whole) picture's width over its height, as lengths; 0: that of square pixels
    double shear = 0.0;   ///< by how much the picture's top lies farther right than its middle, in half heights

    bool orthographic() const { return orthographicHeight > 0.0; }
    bool operator==(const Camera&) const = default;
};

/// The camera's frame. Pixel (x, y), row 0 at the top, sees along
/// forward + (x − centre.x)·perPixelRight + (y − centre.y)·perPixelDown, a vector whose depth along `forward` is 1
/// (perspective) or whose offset is added to the eye (orthographic, direction `forward`).
struct CameraFrame {
    glm::dvec3 eye, forward, right, up;
    glm::dvec3 perPixelRight, perPixelDown;  ///< length at depth 1 (perspective) or mesh units (orthographic)
    glm::dvec2 centre;  ///< pixel coordinates of the optical axis: ((W − 1)/2, (H − 1)/2) unless it is off-centre
    /// Of pixels that are not squares: one row down is rowLean pixel widths to the right and rowStretch of them down.
    double rowLean = 0.0, rowStretch = 1.0;
    double pixel = 0.0;  ///< length of perPixelRight
    /// A point at p from the eye is dot(p, columnAxis)/pixel columns and dot(p, rowAxis)/pixel rows from `centre`
    /// (perspective: times its depth). With square pixels: right, and down.
    glm::dvec3 columnAxis, rowAxis;
    bool orthographic = false;
    int width = 0, height = 0;
    /// Fast engines sample this much beside the pixel's centre (pixels), as EdgeOnPlanes says; cells' numbers include
    /// it.
    glm::dvec2 sampleShift{0x1p-32, 0x1p-33};
    /// Depths in cells' records are beyond this (scene lengths): 0, or the mesh's where the eye is far (depthOriginOf).
    double depthOrigin = 0.0;

    /// Pixels from the optical axis as lengths along `right` and down, in pixel widths.
    glm::dvec2 squared(const glm::dvec2& pixels) const {
        return {pixels.x + rowLean * pixels.y, rowStretch * pixels.y};
    }
};

struct Ray {
    glm::dvec3 origin, direction;  ///< direction has length 1
};

/// \throws std::runtime_error when eye = target, up is parallel to the view, a number is not finite, fov is outside
/// (0, 180), the aspect is negative or the size is not within 1…16384.
CameraFrame cameraFrame(const Camera& camera);

/// The ray through pixel coordinates (x, y); whole numbers are pixel centres.
Ray pixelRay(const CameraFrame& frame, double x, double y);

/// A three-quarter view that holds the whole box, for the camera's size and fov.
glm::dvec3 threeQuarterEye(const mesh::BoundingBox& bounds, const Camera& camera);

/// The eye turned by `angle` radians about the axis `up` through the target.
Camera orbited(const Camera& camera, double angle);

}  // namespace tetralux::projection
