// SPDX-License-Identifier: Apache-2.0
#include <projection/renderer/scene_settings.h>

#include <cmath>
#include <memory>
#include <stdexcept>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <mesh/tet/surface_mesh.h>

namespace tetralux::renderer {

namespace {

glm::dvec3 vec(const Vector& v) {
    return {v[0], v[1], v[2]};
}

bool finite(const Vector& v) {
    return std::isfinite(v[0]) && std::isfinite(v[1]) && std::isfinite(v[2]);
}

std::shared_ptr<const mesh::SurfaceMesh> surfaceMesh(const Surface& surface) {
    auto mesh = std::make_shared<mesh::SurfaceMesh>();
    for (const Vector& point : surface.points) {
        if (!finite(point)) throw std::runtime_error("surface: a point is not finite; leave it out");
        mesh->positions.push_back(vec(point));
    }
    for (const auto& triangle : surface.triangles) {
        for (const std::uint32_t corner : triangle)
            if (corner >= surface.points.size())
                throw std::runtime_error(fmt::format("surface: a triangle names point {} of {}; count from 0", corner,
                                                     surface.points.size()));
        mesh->triangles.push_back(triangle);
    }
    return mesh;
}

shading::Light sceneLight(const Light& light) {
    if (!finite(light.direction) || !finite(light.position) || !finite(light.color) || !finite(light.attenuation))
        throw std::runtime_error("light: a number is not finite; give direction, position and colour as three each");
    shading::Light result;
    result.kind = light.kind == Light::Kind::Point  ? shading::Light::Kind::Point
                  : light.kind == Light::Kind::Head ? shading::Light::Kind::Head
                                                    : shading::Light::Kind::Directional;
    const glm::dvec3 towards = vec(light.direction);
    if (light.kind == Light::Kind::Directional) {
        if (!(glm::length(towards) > 0)) throw std::runtime_error("light: its direction is 0,0,0; give one towards it");
        result.towards = glm::normalize(towards);
    }
    result.position = vec(light.position);
    result.color = vec(light.color);
    result.attenuation = vec(light.attenuation);
    return result;
}

}  // namespace

projection::Mode sceneMode(Mode mode) {
    switch (mode) {
        case Mode::Standard:
            return projection::Mode::Standard;
        case Mode::ScaleInvariant:
            return projection::Mode::ScaleInvariant;
        case Mode::Mip:
            return projection::Mode::Mip;
        case Mode::Minimum:
            return projection::Mode::Minimum;
        case Mode::Average:
            return projection::Mode::Average;
        case Mode::Additive:
            return projection::Mode::Additive;
        case Mode::AdditiveScaleInvariant:
            return projection::Mode::DataAdditive;
        case Mode::Emission:
            return projection::Mode::Emission;
        case Mode::Absorption:
            return projection::Mode::Absorption;
        case Mode::FirstHit:
            return projection::Mode::FirstHit;
        case Mode::Depth:
            return projection::Mode::Depth;
    }
    throw std::runtime_error("mode: there is no such mode");
}

shading::ShadingSettings sceneLighting(const Lighting& lighting) {
    shading::ShadingSettings shading;
    if (!(lighting.ambient >= 0) || !(lighting.exponent >= 0) || !std::isfinite(lighting.ambient + lighting.exponent))
        throw std::runtime_error(fmt::format("lighting: ambient {} and exponent {} must be finite and not below 0",
                                             lighting.ambient, lighting.exponent));
    for (const Light& light : lighting.lights) shading.lights.push_back(sceneLight(light));
    shading.ambient = lighting.ambient;
    shading.exponent = lighting.exponent;
    shading.transmission = lighting.transmission;
    shading.normals = lighting.smoothNormals ? shading::Normals::Smooth : shading::Normals::Cell;
    shading.shadows.on = lighting.shadows;
    return shading;
}

std::vector<projection::HalfSpace> sceneCuts(const std::vector<Cut>& cuts) {
    std::vector<projection::HalfSpace> result;
    for (const Cut& cut : cuts) result.push_back({vec(cut.point), vec(cut.normal)});
    return result;
}

projection::OpaqueObjects sceneObjects(const std::vector<Slice>& slices, const std::vector<Surface>& surfaces) {
    projection::OpaqueObjects objects;
    for (const Slice& slice : slices) {
        if (!finite(slice.plane.point) || !finite(slice.plane.normal) || slice.plane.normal == Vector{0, 0, 0})
            throw std::runtime_error("slice: its plane has no place or direction; give finite numbers");
        if (!(slice.opacity >= 0 && slice.opacity <= 1))
            throw std::runtime_error(fmt::format("slice: opacity {} must lie within 0 and 1", slice.opacity));
        objects.slices.push_back({vec(slice.plane.point), vec(slice.plane.normal), slice.opacity});
    }
    for (const Surface& surface : surfaces)
        objects.surfaces.push_back({surfaceMesh(surface), vec(surface.color), surface.flat});
    return objects;
}

projection::Camera sceneCamera(const Camera& camera, const ImageView& image, const ImageTile& tile) {
    projection::Camera result;
    result.eye = vec(camera.eye);
    result.target = vec(camera.target);
    result.up = vec(camera.up);
    result.fovDegrees = camera.fovDegrees;
    result.orthographicHeight = camera.orthographicHeight;
    result.width = image.width;
    result.height = image.height;
    result.windowCentre = {camera.windowCentre[0], camera.windowCentre[1]};
    if (tile.wholeWidth != 0 || tile.wholeHeight != 0) {
        result.tile = {tile.left, tile.top};
        result.whole = {tile.wholeWidth, tile.wholeHeight};
    }
    return result;
}

}  // namespace tetralux::renderer
