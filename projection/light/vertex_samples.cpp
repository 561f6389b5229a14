// SPDX-License-Identifier: Apache-2.0
#include <projection/light/vertex_samples.h>

#include <algorithm>

#include <glm/geometric.hpp>

#include <mesh/tet/point_cells.h>
#include <projection/core/modes.h>
#include <projection/core/scene_units.h>
#include <shading/vertex_gradients.h>

namespace tetralux::projection {

bool samplesVertices(const Scene& scene) {
    return scene.settings.classification == Classification::Pre && scene.mesh->association == mesh::Association::Point;
}

void addSpecularFactors(const Scene& scene, shading::VertexLight& light) {
    mesh::ScalarMesh extinction = *scene.mesh;
    if (extinction.association == mesh::Association::Cell) return;
    for (double& value : extinction.scalars) value = scene.transferFunction.extinctionAt(value);
    const auto [least, most] = std::minmax_element(extinction.scalars.begin(), extinction.scalars.end());
    if (!(*least < *most)) return;
    extinction.scalarMin = *least;
    extinction.scalarMax = *most;
    const auto gradients =
        shading::vertexGradients(extinction, mesh::PointCells(extinction.cells, extinction.positions.size()));
    double largest = 0;
    for (const glm::dvec3& gradient : gradients) largest = std::max(largest, glm::length(gradient));
    if (!(largest > 0)) return;
    // gradients are in ranges per diagonal
    const bool absolute = scene.settings.shading.material.specularByGradient == shading::GradientSpecular::Absolute;
    const double unit = absolute ? (*most - *least) / extinction.bounds.diagonal() : 1 / largest;
    for (std::size_t point = 0; point < gradients.size(); ++point)
        light.of(point)[light.specularAt] = static_cast<float>(glm::length(gradients[point]) * unit);
}

void addSamples(const Scene& scene, shading::VertexLight& light) {
    const mesh::ScalarMesh& mesh = *scene.mesh;
    const SceneUnits units = sceneUnits(mesh);
    const bool overLength = integralOf(scene.settings.mode) == preint::Integral::Standard;
    const double perUnit = overLength ? units.length : units.scalarScale;
    for (std::size_t point = 0; point < mesh.scalars.size(); ++point) {
        const double scalar = mesh.scalars[point];
        const glm::dvec3 color = scene.transferFunction.colorAt(scalar);
        float* sample = light.of(point) + light.sampleAt;
        for (int i = 0; i < 3; ++i) sample[i] = static_cast<float>(color[i]);
        sample[3] = static_cast<float>(scene.transferFunction.extinctionAt(scalar) * perUnit);
    }
}

}  // namespace tetralux::projection
