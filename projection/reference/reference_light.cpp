// SPDX-License-Identifier: Apache-2.0
#include <projection/reference/reference_light.h>

#include <algorithm>
#include <array>

#include <glm/geometric.hpp>

#include <projection/cells/cell_shading.h>
#include <projection/light/arriving_light.h>

namespace tetralux::projection {

std::array<double, 4> innerCoordinates(const mesh::ScalarMesh& mesh, mesh::CellIndex cell, const glm::dvec3& x) {
    const mesh::Tetrahedron& corners = mesh.cells[cell];
    std::array<double, 4> weights;
    double sum = 0;
    for (std::size_t k = 0; k < 4; ++k) {
        const auto& face = mesh::faceVertices[k];
        const auto corner = [&](std::size_t i) { return mesh.positions[corners[static_cast<std::size_t>(face[i])]]; };
        weights[k] = std::max(0.0, mesh::sixVolumes(x, corner(0), corner(1), corner(2)));
        sum += weights[k];
    }
    for (double& weight : weights) weight = sum > 0 ? weight / sum : 0.25;
    return weights;
}

namespace {

/// The vertices' attributes at a place in a cell.
class AttributesAt {
public:
    AttributesAt(const Scene& scene, mesh::CellIndex cell, const glm::dvec3& place) : light_(*scene.vertexLight) {
        if (!light_.any()) return;
        corners_ = light_.cornersOf(cell, scene.mesh->cells[cell]);
        weights_ = innerCoordinates(*scene.mesh, cell, place);
    }
    double at(int place) const {
        double sum = 0;
        for (std::size_t k = 0; k < 4; ++k) sum += weights_[k] * static_cast<double>(light_.of(corners_[k])[place]);
        return sum;
    }
    glm::dvec3 vectorAt(int place) const { return {at(place), at(place + 1), at(place + 2)}; }

private:
    const shading::VertexLight& light_;
    mesh::Tetrahedron corners_{};
    std::array<double, 4> weights_{};
};

glsl::LightModel modelOf(const shading::ShadingSettings& settings) {
    const shading::Material& material = settings.material;
    const double through = settings.transmission ? 1.0 : 0.0;
    return {static_cast<int>(settings.reflectance),
            material.phaseAsymmetry ? 1 : 0,
            material.front.specular,
            material.back.specular,
            settings.exponentOf(material.front),
            settings.exponentOf(material.back),
            material.diffuse,
            material.specular,
            through * material.diffuseTransmission,
            through * material.specularTransmission,
            settings.wardRoughness(),
            settings.anisotropy.gamma,
            material.phaseAsymmetry.value_or(0.0)};
}

/// What the isosurfaces of the segment's cell leave of a light that comes from `towards`.
double surfaceShadows(const Scene& scene, const SegmentToLight& segment, const glm::dvec3& towards) {
    if (scene.vertexLight->corners.empty()) return 1.0;
    double low = scene.mesh->scalarAt(segment.cell, 0), high = low, through = 1.0;
    for (int k = 1; k < 4; ++k) {
        low = std::min(low, scene.mesh->scalarAt(segment.cell, k));
        high = std::max(high, scene.mesh->scalarAt(segment.cell, k));
    }
    const double rise = glm::dot(segment.fieldNormal, towards);
    for (const preint::Isosurface& surface : scene.transferFunction.isosurfaces)
        through *= glsl::surfaceShadow(surface.value, surface.opacity, segment.front, segment.back, low, high, rise);
    return through;
}

}  // namespace

glm::dvec3 smoothGradient(const Scene& scene, mesh::CellIndex cell, const glm::dvec3& x) {
    return AttributesAt(scene, cell, x).vectorAt(scene.vertexLight->normalAt);
}

glm::dvec3 litColor(const Scene& scene, const SegmentToLight& segment) {
    const shading::ShadingSettings& settings = scene.settings.shading;
    const shading::VertexLight& kept = *scene.vertexLight;
    const AttributesAt attributes(scene, segment.cell, segment.middle);
    glsl::LightModel model = modelOf(settings);
    if (kept.specularAt >= 0) {
        const double factor = attributes.at(kept.specularAt);
        model.specular = factor;
        model.specularThrough *= factor;
    }
    glsl::LitPoint point{};
    point.normal = segment.normal;
    if (kept.normalAt >= 0 && !segment.cut) {
        const glm::dvec3 gradient = attributes.vectorAt(kept.normalAt);
        const double magnitude = glm::length(gradient);
        point.normal = magnitude > 0 ? gradient / magnitude : glm::dvec3(0);
    }
    point.view = -segment.direction;
    point.side = segment.side;
    point.opacity = segment.opacity;

    glm::dvec3 light = settings.ambient * settings.ambientColor * segment.color;
    if (!settings.material.phaseAsymmetry && point.normal == glm::dvec3(0)) return light;
    if (settings.needsAnisotropy())
        glsl::setAnisotropy(model, attributes.vectorAt(kept.tensorAt), attributes.vectorAt(kept.tensorAt + 3), point);
    for (std::size_t i = 0; i < settings.lights.size(); ++i) {
        const ArrivingLight source =
            arrivingLight(settings.lights[i], segment.middle, segment.direction, segment.fromEye);
        double shadow = 1.0;
        if (kept.shadowAt >= 0)
            shadow =
                attributes.at(kept.shadowAt + static_cast<int>(i)) * surfaceShadows(scene, segment, source.towards);
        light += shadow * source.color * glsl::modelTerm(model, point, segment.color, source.towards);
    }
    return light;
}

}  // namespace tetralux::projection
