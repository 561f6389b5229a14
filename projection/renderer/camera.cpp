// SPDX-License-Identifier: Apache-2.0
// Cameras of the public library: from a host's matrix, by name, and about a box.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include <projection/core/camera.h>
#include <projection/core/fitted_view.h>
#include <projection/renderer/errors.h>
#include <projection/renderer/scene_settings.h>
#include <tetralux/tetralux.h>

namespace tetralux {

namespace {

// What is public stands without the library's own headers; defaults are one all the same.
static_assert(FittedView{}.margin == projection::defaultMargin);
static_assert(FittedView{}.direction == Vector{projection::ViewDirection{}.forward.x,
                                               projection::ViewDirection{}.forward.y,
                                               projection::ViewDirection{}.forward.z});
static_assert(FittedView{}.up == Vector{projection::ViewDirection{}.up.x, projection::ViewDirection{}.up.y,
                                        projection::ViewDirection{}.up.z});

[[noreturn]] void noPicture(const char* why) {
    throw Error(Errc::BadInput, fmt::format("camera: the matrix {}; give projection · view, row after row", why));
}

/// How clip coordinates x, y, z and w follow from a place: dot(form[i], place) + offset[i].
struct ClipForms {
    std::array<glm::dvec3, 4> form;
    std::array<double, 4> offset;

    explicit ClipForms(const std::array<double, 16>& m) : form(), offset() {
        for (std::size_t i = 0; i < 4; ++i) {
            form[i] = {m[4 * i], m[4 * i + 1], m[4 * i + 2]};
            offset[i] = m[4 * i + 3];
        }
    }
    /// Where three of them have these values. \throws Error when there is no such point, or no single one.
    glm::dvec3 placeOf(const std::array<std::size_t, 3>& which, const glm::dvec3& values) const {
        glm::dmat3 rows;
        glm::dvec3 right;
        for (int i = 0; i < 3; ++i) {
            const std::size_t k = which[static_cast<std::size_t>(i)];
            const double size = glm::length(form[k]);  // equations of a like size, whatever their units
            if (!(size > 0)) noPicture("is singular");
            rows[i] = form[k] / size;
            right[i] = (values[i] - offset[k]) / size;
        }
        const double determinant = glm::determinant(rows);
        if (!(std::abs(determinant) > 1e-12)) noPicture("is singular");
        return glm::inverse(glm::transpose(rows)) * right;
    }
};

/// Where the picture lies before the eye: its middle, its right edge and its top, from its middle; perspective: at a
/// depth of 1.
struct Window {
    glm::dvec3 eye, forward;
    glm::dvec3 middle{0};  ///< from the optical axis
    glm::dvec3 halfWidth, halfHeight;
};

/// A pixel at (x, y) is the line in which the planes clip x = x·w and y = y·w meet.
Window perspectiveWindow(const ClipForms& clip) {
    const auto& [x, y, z, w] = clip.form;
    Window window;
    window.eye = clip.placeOf({0, 1, 3}, glm::dvec3(0));
    window.forward = glm::normalize(w);
    const double perDepth = glm::length(w) / glm::dot(w, glm::cross(x, y));
    const glm::dvec3 middle = glm::cross(x, y) * perDepth;
    window.middle = middle - glm::dot(middle, window.forward) * window.forward;
    window.halfWidth = glm::cross(y, w) * perDepth;
    window.halfHeight = glm::cross(w, x) * perDepth;
    return window;
}

Window parallelWindow(const ClipForms& clip) {
    const auto& [x, y, z, w] = clip.form;
    const double scale = clip.offset[3];
    if (!(scale > 0)) noPicture("has a last row that is not above 0");
    const std::array<std::size_t, 3> picture{0, 1, 2};
    Window window;
    window.eye = clip.placeOf(picture, {0, 0, -scale});
    window.forward = glm::normalize(glm::cross(x, y));
    if (glm::dot(window.forward, z) < 0) window.forward = -window.forward;
    const glm::dvec3 alongX = glm::cross(y, window.forward), alongY = glm::cross(window.forward, x);
    window.halfWidth = alongX * (scale / glm::dot(x, alongX));
    window.halfHeight = alongY * (scale / glm::dot(y, alongY));
    double nearest = 0;  // a corner of the nearest plane may stand before its middle
    for (const double sideX : {-1.0, 1.0})
        for (const double sideY : {-1.0, 1.0})
            nearest = std::min(
                nearest,
                glm::dot(window.forward, clip.placeOf(picture, scale * glm::dvec3(sideX, sideY, -1)) - window.eye));
    window.eye += nearest * window.forward;
    return window;
}

}  // namespace

Camera Camera::fromMatrix(const std::array<double, 16>& clipFromWorld) {
    for (const double value : clipFromWorld)
        if (!std::isfinite(value)) noPicture("holds a number that is not finite");
    const ClipForms clip(clipFromWorld);
    const bool parallel = clip.form[3] == glm::dvec3(0);
    const Window window = parallel ? parallelWindow(clip) : perspectiveWindow(clip);
    if (!(glm::dot(glm::cross(window.halfWidth, window.halfHeight), window.forward) < 0))
        throw Error(
            Errc::BadInput,
            "camera: the matrix mirrors the picture; turn the sign of its second row, and the rows of the image");
    const double width = glm::length(window.halfWidth);
    const glm::dvec3 right = window.halfWidth / width, up = glm::cross(right, window.forward);
    const double height = glm::dot(window.halfHeight, up);
    Camera camera;
    camera.eye = renderer::arrayOf(window.eye);
    // so far away that its direction is not lost where the eye stands far from the origin
    camera.target = renderer::arrayOf(window.eye + std::max(1.0, glm::length(window.eye)) * window.forward);
    camera.up = renderer::arrayOf(up);
    camera.aspect = width / height;
    camera.shear = glm::dot(window.halfHeight, right) / height;
    if (parallel) {
        camera.orthographicHeight = 2 * height;
        return camera;
    }
    camera.fovDegrees = 2 * std::atan(height) * 180 / std::numbers::pi;
    const double aboveAxis = glm::dot(window.middle, up) / height;
    camera.windowCentre = {glm::dot(window.middle, right) / width - aboveAxis * camera.shear / camera.aspect,
                           aboveAxis};
    return camera;
}

FittedView FittedView::named(std::string_view name) {
    return renderer::translated([&] {
        const projection::ViewDirection view = projection::namedView(std::string(name));
        FittedView result;
        result.direction = renderer::arrayOf(view.forward);
        result.up = renderer::arrayOf(view.up);
        return result;
    });
}

Camera cameraHolding(const BoundingBox& bounds, int width, int height, const Camera& like) {
    const mesh::BoundingBox box{{bounds.low[0], bounds.low[1], bounds.low[2]},
                                {bounds.high[0], bounds.high[1], bounds.high[2]}};
    ImageView size;
    size.width = std::max(1, width);
    size.height = std::max(1, height);
    const projection::Camera view = renderer::sceneCamera(like, size, {});
    Camera camera = like;
    camera.target = renderer::arrayOf(box.centre());
    camera.eye = renderer::arrayOf(projection::threeQuarterEye(box, view));
    return camera;
}

}  // namespace tetralux
