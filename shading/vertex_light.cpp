// SPDX-License-Identifier: Apache-2.0
#include <shading/vertex_light.h>

#include <algorithm>

#include <mesh/tet/point_cells.h>
#include <shading/vertex_gradients.h>

namespace tetralux::shading {

std::vector<Tensor> vertexTensors(const mesh::ScalarMesh& mesh, const AnisotropySettings& settings) {
    const mesh::PointCells around(mesh.cells, mesh.positions.size());
    return levelSetTensors(mesh, vertexGradients(mesh, around), settings);
}

VertexLight vertexLight(const mesh::ScalarMesh& mesh, const ShadingSettings& settings, bool sampled,
                        const std::vector<Tensor>* kept) {
    VertexLight light;
    int floats = 0;
    const auto take = [&](int count) {
        floats += count;
        return floats - count;
    };
    if (settings.needsSmoothNormals()) light.normalAt = take(3);
    if (settings.needsAnisotropy()) light.tensorAt = take(6);
    if (settings.needsShadows()) light.shadowAt = take(static_cast<int>(settings.lights.size()));
    if (settings.lit() && settings.material.specularByGradient != GradientSpecular::Off) light.specularAt = take(1);
    if (sampled) light.sampleAt = take(4);
    if (floats == 0) return light;
    light.stride = (floats + 3) / 4 * 4;
    light.values.assign(mesh.positions.size() * static_cast<std::size_t>(light.stride), 0.0f);

    std::vector<glm::dvec3> gradients;
    if (light.normalAt >= 0 || (light.tensorAt >= 0 && kept == nullptr))
        gradients = vertexGradients(mesh, mesh::PointCells(mesh.cells, mesh.positions.size()));
    std::vector<Tensor> computed;
    if (light.tensorAt >= 0 && kept == nullptr) computed = levelSetTensors(mesh, gradients, settings.anisotropy);
    const std::vector<Tensor>& tensors = kept != nullptr ? *kept : computed;
    for (std::size_t point = 0; point < mesh.positions.size(); ++point) {
        float* values = light.of(point);
        if (light.normalAt >= 0)
            for (int axis = 0; axis < 3; ++axis)
                values[light.normalAt + axis] = static_cast<float>(gradients[point][axis]);
        if (light.tensorAt >= 0)
            std::transform(tensors[point].begin(), tensors[point].end(), values + light.tensorAt,
                           [](double moment) { return static_cast<float>(moment); });
        if (light.specularAt >= 0) values[light.specularAt] = 1.0f;
        if (light.shadowAt >= 0) std::fill_n(values + light.shadowAt, settings.lights.size(), 1.0f);
    }
    return light;
}

}  // namespace tetralux::shading
