// SPDX-License-Identifier: Apache-2.0
#include <projection/cells/camera_points.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <glm/geometric.hpp>

namespace tetralux::projection {

namespace {

/// Pixels beyond this are as far outside as they need to be.
constexpr double farthestPixel = 1e9;

}  // namespace

CameraAxes cameraAxes(const CameraFrame& frame, const SceneUnits& units) {
    const double perLength = 1.0 / units.length;
    const double across = frame.orthographic ? 1.0 / frame.pixel : perLength / frame.pixel;
    return {frame.columnAxis * across, frame.rowAxis * across, frame.forward * perLength};
}

void projectPoints(const mesh::ScalarMesh& mesh, const SceneUnits& units, const CameraFrame& frame,
                   std::vector<CameraPoint>& points) {
    points.resize(mesh.positions.size());
    const CameraAxes axes = cameraAxes(frame, units);
    const glm::dvec2 centre = sampleCentre(frame);
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, points.size(), 4096), [&](const auto& range) {
        for (std::size_t i = range.begin(); i != range.end(); ++i) {
            const glm::dvec3 fromEye = mesh.positions[i] - frame.eye;
            CameraPoint p{glm::dot(fromEye, axes.right), glm::dot(fromEye, axes.down), glm::dot(fromEye, axes.forward),
                          0, 0};
            const double ratio = frame.orthographic ? 1.0 : 1.0 / p.z;
            if (frame.orthographic || p.z > 0) {
                p.pixelX = static_cast<float>(std::clamp(centre.x + p.x * ratio, -farthestPixel, farthestPixel));
                p.pixelY = static_cast<float>(std::clamp(centre.y + p.y * ratio, -farthestPixel, farthestPixel));
            } else {
                p.pixelX = p.pixelY = std::numeric_limits<float>::quiet_NaN();
            }
            points[i] = p;
        }
    });
}

}  // namespace tetralux::projection
