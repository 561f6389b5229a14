// SPDX-License-Identifier: Apache-2.0
#include "view_camera.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "vtkCamera.h"
#include "vtkMatrix4x4.h"
#include "vtkNew.h"
#include "vtkRenderer.h"

namespace tetralux::vtk {

namespace {

double dot(const Vector& a, const Vector& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// Into the picture, of length 1.
Vector forwardOf(const Camera& camera) {
    Vector forward;
    for (std::size_t i = 0; i < 3; ++i) forward[i] = camera.target[i] - camera.eye[i];
    const double length = std::sqrt(dot(forward, forward));
    for (double& x : forward) x /= length;
    return forward;
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

    std::array<double, 16> matrix{};
    std::copy_n(&clipFromWorld->Element[0][0], 16, matrix.begin());
    view.camera = Camera::fromMatrix(matrix);
    return view;
}

std::vector<float> distancesOf(const WindowView& view, const std::vector<float>& depths) {
    const Camera& camera = view.camera;
    const bool parallel = camera.orthographicHeight > 0;
    const Vector forward = forwardOf(camera);
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
            const double reach = parallel ? dot(away, forward) : std::sqrt(dot(away, away));
            distance[x] = depth[x] < 1 ? static_cast<float>(reach) : std::numeric_limits<float>::infinity();
        }
    }
    return distances;
}

}  // namespace tetralux::vtk
