// SPDX-License-Identifier: Apache-2.0
#include "view_camera.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "vtkCamera.h"
#include "vtkMatrix4x4.h"
#include "vtkNew.h"
#include "vtkRenderer.h"

namespace tetralux::vtk {

namespace {

Vector operator+(const Vector& a, const Vector& b) {
    return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
Vector operator*(double s, const Vector& a) {
    return {s * a[0], s * a[1], s * a[2]};
}
double dot(const Vector& a, const Vector& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
Vector cross(const Vector& a, const Vector& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
double length(const Vector& a) {
    return std::sqrt(dot(a, a));
}

/// A row of the matrix that makes clip coordinates, about a point: normal·(p − point) + offset.
struct Row {
    Vector normal;
    double offset;
};

Row rowOf(const vtkMatrix4x4& matrix, int row, const Vector& point) {
    const double* m = matrix.Element[row];
    const Vector normal{m[0], m[1], m[2]};
    return {normal, dot(normal, point) + m[3]};
}

/// Where three planes meet, from the point that their offsets are about.
Vector meeting(const Row& a, const Row& b, const Row& c) {
    const Vector bc = cross(b.normal, c.normal), ca = cross(c.normal, a.normal), ab = cross(a.normal, b.normal);
    return (-1 / dot(a.normal, bc)) * (a.offset * bc + b.offset * ca + c.offset * ab);
}

[[noreturn]] void refuse() {
    throw Error(Errc::Unsupported,
                "the camera stretches or mirrors the picture; use one with square pixels, without view shear");
}

/// The picture's axes must be at right angles and measure alike.
void requireSquare(const Vector& right, const Vector& up, const Vector& forward, const WindowPart& part) {
    const double x = length(right) * part.width, y = length(up) * part.height;
    constexpr double tolerance = 1e-6;
    const bool square = std::abs(x - y) <= tolerance * std::max(x, y) &&
                        std::abs(dot(right, up)) <= tolerance * length(right) * length(up);
    if (!square || !(dot(cross(forward, up), right) > 0)) refuse();
}

Camera perspective(const Row rows[4], const Vector& position, double distance, const WindowPart& part) {
    constexpr double degreesOfRadian = 57.29577951308232;
    const double scale = length(rows[3].normal);
    const Vector forward = (1 / scale) * rows[3].normal;
    const double offRight = dot(rows[0].normal, forward) / scale, offUp = dot(rows[1].normal, forward) / scale;
    const Vector right = (1 / scale) * rows[0].normal + -offRight * forward;
    const Vector up = (1 / scale) * rows[1].normal + -offUp * forward;
    requireSquare(right, up, forward, part);
    Camera camera;
    camera.eye = position + meeting(rows[0], rows[1], rows[3]);
    camera.target = camera.eye + distance * forward;
    camera.up = up;
    camera.fovDegrees = 2 * std::atan(1 / length(up)) * degreesOfRadian;
    camera.windowCentre = {-offRight, -offUp};
    return camera;
}

Camera orthographic(const Row rows[4], const Vector& position, double distance, const WindowPart& part) {
    const double scale = rows[3].offset;
    const Vector right = (1 / scale) * rows[0].normal, up = (1 / scale) * rows[1].normal;
    Vector forward = cross(up, right);
    if (!(dot(forward, rows[2].normal) * scale > 0)) refuse();
    forward = (1 / length(forward)) * forward;
    requireSquare(right, up, forward, part);
    Camera camera;
    camera.eye = position + meeting(rows[0], rows[1], {forward, 0});  // in the plane through the camera's place
    camera.target = camera.eye + distance * forward;
    camera.up = up;
    camera.orthographicHeight = 2 / length(up);
    return camera;
}

}  // namespace

WindowView viewOf(vtkRenderer& renderer) {
    WindowView view;
    renderer.GetTiledSizeAndOrigin(&view.part.width, &view.part.height, &view.part.left, &view.part.bottom);
    vtkCamera& vtkView = *renderer.GetActiveCamera();
    vtkNew<vtkMatrix4x4> clipFromWorld, inverse;  // what actors are drawn by; VTK's composite matrix leaves stereo out
    vtkMatrix4x4::Multiply4x4(vtkView.GetProjectionTransformMatrix(renderer.GetTiledAspectRatio(), -1, 1),
                              vtkView.GetModelViewTransformMatrix(), clipFromWorld);
    vtkMatrix4x4::Invert(clipFromWorld, inverse);
    std::copy_n(&inverse->Element[0][0], 16, view.worldFromClip.begin());

    Vector position;
    vtkView.GetPosition(position.data());
    Row rows[4];
    for (int row = 0; row < 4; ++row) rows[row] = rowOf(*clipFromWorld, row, position);
    view.camera = length(rows[3].normal) > 0 ? perspective(rows, position, vtkView.GetDistance(), view.part)
                                             : orthographic(rows, position, vtkView.GetDistance(), view.part);
    return view;
}

std::vector<float> distancesOf(const WindowView& view, const std::vector<float>& depths) {
    const Camera& camera = view.camera;
    const bool parallel = camera.orthographicHeight > 0;
    Vector forward = camera.target + -1 * camera.eye;
    forward = (1 / length(forward)) * forward;
    const auto& m = view.worldFromClip;
    const auto width = static_cast<std::size_t>(view.part.width), height = static_cast<std::size_t>(view.part.height);
    std::vector<float> distances(depths.size());
    for (std::size_t y = 0; y < height; ++y) {
        const double clipY = (2 * static_cast<double>(y) + 1) / static_cast<double>(height) - 1;
        const float* depth = &depths[y * width];
        float* distance = &distances[(height - 1 - y) * width];
        for (std::size_t x = 0; x < width; ++x) {
            const double clipX = (2 * static_cast<double>(x) + 1) / static_cast<double>(width) - 1;
            const double clipZ = 2 * static_cast<double>(depth[x]) - 1;
            double p[4];
            for (std::size_t row = 0; row < 4; ++row)
                p[row] = m[4 * row] * clipX + m[4 * row + 1] * clipY + m[4 * row + 2] * clipZ + m[4 * row + 3];
            const Vector away{p[0] / p[3] - camera.eye[0], p[1] / p[3] - camera.eye[1], p[2] / p[3] - camera.eye[2]};
            const double reach = parallel ? dot(away, forward) : length(away);
            distance[x] = depth[x] < 1 ? static_cast<float>(reach) : std::numeric_limits<float>::infinity();
        }
    }
    return distances;
}

}  // namespace tetralux::vtk
