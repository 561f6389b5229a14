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
    if (!surface.scalars.empty() && surface.scalars.size() != surface.points.size())
        throw std::runtime_error(fmt::format("surface: {} scalars for {} points; give one for each",
                                             surface.scalars.size(), surface.points.size()));
    for (const double scalar : surface.scalars)
        if (!std::isfinite(scalar))
            throw std::runtime_error("surface: a scalar is not finite; leave its triangles out");
    mesh->scalars = surface.scalars;
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
    for (const Surface& surface : surfaces) {
        projection::OpaqueSurface one;
        one.mesh = surfaceMesh(surface);
        one.color = vec(surface.color);
        one.flat = surface.flat;
        one.byField = !surface.scalars.empty();
        one.opacity = surface.opacity;
        objects.surfaces.push_back(std::move(one));
    }
    return objects;
}

projection::BoundaryLook boundaryLook(const Boundary& boundary) {
    const bool angle = boundary.featureAngle >= 0 && boundary.featureAngle <= 180;
    if (!(boundary.opacity > 0 && boundary.opacity <= 1) || !angle || !(boundary.edgeWidth > 0))
        throw std::runtime_error(
            fmt::format("boundary: opacity {} (above 0, up to 1), feature angle {} (0 to 180 degrees) or edge width {} "
                        "(above 0) will not do",
                        boundary.opacity, boundary.featureAngle, boundary.edgeWidth));
    projection::BoundaryLook look;
    look.opacity = boundary.opacity;
    if (boundary.color) look.color = vec(*boundary.color);
    look.flat = boundary.flat;
    look.featureAngle = boundary.featureAngle;
    if (boundary.edges) look.edges = projection::SurfaceEdges{boundary.edgeWidth, vec(boundary.edgeColor)};
    return look;
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
    result.aspect = camera.aspect;
    result.shear = camera.shear;
    if (tile.wholeWidth != 0 || tile.wholeHeight != 0) {
        result.tile = {tile.left, tile.top};
        result.whole = {tile.wholeWidth, tile.wholeHeight};
    }
    return result;
}

Camera publicCamera(const projection::Camera& camera) {
    Camera result;
    result.eye = arrayOf(camera.eye);
    result.target = arrayOf(camera.target);
    result.up = arrayOf(camera.up);
    result.fovDegrees = camera.fovDegrees;
    result.orthographicHeight = camera.orthographicHeight;
    result.windowCentre = {camera.windowCentre.x, camera.windowCentre.y};
    result.aspect = camera.aspect;
    result.shear = camera.shear;
    return result;
}

projection::Camera fittedSceneCamera(const FittedView& view, std::span<const glm::dvec3> points, int width,
                                     int height) {
    if (width < 1 || height < 1)
        throw std::runtime_error(fmt::format("view: a picture of {}x{} pixels; give 1 at least", width, height));
    if (!(view.margin >= 0 && view.margin < 0.5))
        throw std::runtime_error(
            fmt::format("view: a margin of {} leaves no room; give a share below 0.5", view.margin));
    projection::Camera camera;
    camera.width = width;
    camera.height = height;
    camera.fovDegrees = view.fovDegrees;
    camera.orthographicHeight = view.orthographic ? 1.0 : 0.0;
    const projection::ViewDirection direction = projection::turned(
        projection::ViewDirection{vec(view.direction), vec(view.up)}, {view.azimuth, view.elevation, view.roll});
    return projection::zoomed(
        projection::fitted(camera, direction, points, projection::evenMargins(view.margin, width, height)), view.zoom);
}

}  // namespace tetralux::renderer
