// SPDX-License-Identifier: Apache-2.0
#include <projection/cell_setup.h>

#include <algorithm>
#include <cmath>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <glm/geometric.hpp>

namespace tetralux::projection {

namespace {

/// Least |λ(eye)| of a face, so that its plane stays finite in float when it is seen edge-on.
constexpr double leastEyeCoordinate = 1e-20;

/// Depths below this share of the cell's largest depth count as behind the eye.
constexpr double nearestDepthShare = 1e-6;

double determinant(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    return glm::dot(a, glm::cross(b, c));
}

}  // namespace

SceneUnits sceneUnits(const mesh::ScalarMesh& mesh) {
    SceneUnits units;
    units.scalarOffset = mesh.scalarMin;
    double range = mesh.scalarMax - mesh.scalarMin;
    units.scalarScale = range > 0 ? range : 1.0;
    double diagonal = mesh.bounds.diagonal();
    units.length = diagonal > 0 ? diagonal : 1.0;
    return units;
}

preint::TransferFunction inSceneUnits(const preint::TransferFunction& function, const SceneUnits& units,
                                      preint::Integral integral) {
    preint::TransferFunction result = function;
    double extinctionScale = integral == preint::Integral::Standard ? units.length : units.scalarScale;
    for (auto& node : result.color) node.scalar = units.toUnit(node.scalar);
    for (auto& node : result.extinction) {
        node.scalar = units.toUnit(node.scalar);
        node.extinction *= extinctionScale;
    }
    for (auto& surface : result.isosurfaces) surface.value = units.toUnit(surface.value);
    return result;
}

const char* skipReasonName(SkipReason reason) {
    switch (reason) {
        case SkipReason::None:
            return "none";
        case SkipReason::OutsideView:
            return "outside view";
        case SkipReason::NoPixelCentre:
            return "no pixel centre";
        case SkipReason::Invisible:
            return "invisible by transfer function";
    }
    return "";
}

CellProjector::CellProjector(const mesh::ScalarMesh& mesh, const SceneUnits& units, const CameraFrame& frame)
    : mesh_(mesh), units_(units), frame_(frame), cameraPoints_(mesh.positions.size()) {
    const double pixel = glm::length(frame.perPixelRight);
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, mesh.positions.size(), 4096), [&](const auto& range) {
        for (std::size_t i = range.begin(); i != range.end(); ++i) {
            const glm::dvec3 fromEye = mesh.positions[i] - frame_.eye;
            cameraPoints_[i] = {glm::dot(fromEye, frame_.right) / pixel, -glm::dot(fromEye, frame_.up) / pixel,
                                glm::dot(fromEye, frame_.forward)};
        }
    });
}

glm::dvec2 CellProjector::pixelOf(const glm::dvec3& point) const {
    if (frame_.orthographic) return frame_.centre + glm::dvec2(point.x, point.y);
    return frame_.centre + glm::dvec2(point.x / point.z, point.y / point.z);
}

SkipReason CellProjector::bounds(mesh::CellIndex cell, PixelRect& rect) const {
    std::array<glm::dvec3, 4> v;
    double deepest = -std::numeric_limits<double>::infinity(), nearest = -deepest;
    for (std::size_t k = 0; k < 4; ++k) {
        v[k] = cameraPoints_[mesh_.cells[cell][k]];
        deepest = std::max(deepest, v[k].z);
        nearest = std::min(nearest, v[k].z);
    }
    if (!(deepest > 0)) return SkipReason::OutsideView;

    glm::dvec2 low(std::numeric_limits<double>::infinity()), high(-low.x);
    auto include = [&](const glm::dvec2& p) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    };
    const double clip = frame_.orthographic ? nearest : nearestDepthShare * deepest;
    for (std::size_t k = 0; k < 4; ++k) {
        if (v[k].z >= clip) {
            include(pixelOf(v[k]));
            continue;
        }
        for (std::size_t j = 0; j < 4; ++j)  // where the edge from behind comes to the front
            if (v[j].z > clip) include(pixelOf(glm::mix(v[k], v[j], (clip - v[k].z) / (v[j].z - v[k].z))));
    }
    low -= frame_.sampleShift;
    high -= frame_.sampleShift;
    if (!(high.x >= 0 && high.y >= 0 && low.x <= frame_.width - 1 && low.y <= frame_.height - 1))
        return SkipReason::OutsideView;
    auto clampTo = [](double value, int limit) { return std::clamp(value, 0.0, static_cast<double>(limit)); };
    rect.x0 = static_cast<int>(clampTo(std::ceil(low.x), frame_.width));
    rect.y0 = static_cast<int>(clampTo(std::ceil(low.y), frame_.height));
    rect.x1 = static_cast<int>(clampTo(std::floor(high.x) + 1, frame_.width));
    rect.y1 = static_cast<int>(clampTo(std::floor(high.y) + 1, frame_.height));
    return rect.empty() ? SkipReason::NoPixelCentre : SkipReason::None;
}

std::optional<std::array<glm::dvec2, 4>> CellProjector::corners(mesh::CellIndex cell) const {
    std::array<glm::dvec2, 4> result;
    double deepest = 0;
    for (std::size_t k = 0; k < 4; ++k) deepest = std::max(deepest, cameraPoints_[mesh_.cells[cell][k]].z);
    for (std::size_t k = 0; k < 4; ++k) {
        const glm::dvec3& point = cameraPoints_[mesh_.cells[cell][k]];
        if (!frame_.orthographic && point.z < nearestDepthShare * deepest) return std::nullopt;
        result[k] = pixelOf(point) - frame_.sampleShift;
    }
    return result;
}

/// det(a, b − a, c − a) of the face as seen from the eye (orthographic: its extent along the view), taken in the
/// order of the point numbers so that the two cells of a face compute the same magnitude with opposite signs. Positive
/// when the eye is on the inner side.
double CellProjector::eyeSide(const mesh::Tetrahedron& cell, int face) const {
    std::array<std::uint32_t, 3> p;
    for (std::size_t k = 0; k < 3; ++k)
        p[k] = cell[static_cast<std::size_t>(mesh::faceVertices[static_cast<std::size_t>(face)][k])];
    double sign = 1.0;
    auto order = [&](std::size_t i, std::size_t j) {
        if (p[i] > p[j]) {
            std::swap(p[i], p[j]);
            sign = -sign;
        }
    };
    order(0, 1);
    order(1, 2);
    order(0, 1);
    const glm::dvec3 a = cameraPoints_[p[0]], ab = cameraPoints_[p[1]] - a, ac = cameraPoints_[p[2]] - a;
    if (frame_.orthographic) return sign * (ab.x * ac.y - ab.y * ac.x);
    return sign * determinant(a, ab, ac);
}

bool CellProjector::faceIsFront(mesh::CellIndex cell, int face) const {
    return eyeSide(mesh_.cells[cell], face) < 0;
}

/// λ_k(p) = eye[k] + dot(gradient[k], p) in camera space (right-handed: right, down, forward). Orthographic: eye[k] is
/// the rate of λ_k towards the eye, per depth.
struct CellProjector::LinearForms {
    std::array<glm::dvec3, 4> gradient;
    std::array<double, 4> eye;
    glm::dvec3 centroid;
    double deepest, nearest;
};

CellProjector::LinearForms CellProjector::linearForms(mesh::CellIndex cell) const {
    const mesh::Tetrahedron& points = mesh_.cells[cell];
    const glm::dvec3 a = cameraPoints_[points[0]];
    const glm::dvec3 ab = cameraPoints_[points[1]] - a, ac = cameraPoints_[points[2]] - a,
                     ad = cameraPoints_[points[3]] - a;
    LinearForms forms;
    forms.centroid = a + 0.25 * (ab + ac + ad);
    forms.deepest = a.z + std::max({0.0, ab.z, ac.z, ad.z});
    forms.nearest = a.z + std::min({0.0, ab.z, ac.z, ad.z});
    const glm::dvec3 cd = glm::cross(ac, ad), db = glm::cross(ad, ab), bc = glm::cross(ab, ac);
    const double inverse = 1.0 / glm::dot(ab, cd);
    forms.gradient[1] = cd * inverse;
    forms.gradient[2] = db * inverse;
    forms.gradient[3] = bc * inverse;
    forms.gradient[0] = -(forms.gradient[1] + forms.gradient[2] + forms.gradient[3]);
    const double absoluteInverse = std::abs(inverse);
    for (int k = 0; k < 4; ++k) forms.eye[static_cast<std::size_t>(k)] = eyeSide(points, k) * absoluteInverse;
    return forms;
}

CellRecord CellProjector::record(mesh::CellIndex cell, const PixelRect& rect) const {
    const LinearForms forms = linearForms(cell);
    const bool orthographic = frame_.orthographic;

    // the reference point c: position on the image (relative to the optical axis) and depth
    glm::dvec2 image;
    double depth;
    const bool inFront = orthographic || forms.nearest > 0.1 * forms.deepest;
    if (inFront) {
        depth = forms.centroid.z;
        if (orthographic && depth == 0) depth = 1e-9 * units_.length;
        image = glm::dvec2(forms.centroid.x, forms.centroid.y);
        if (!orthographic) image /= depth;
    } else {
        depth = 0.5 * forms.deepest;
        image = glm::dvec2(0.5 * (rect.x0 + rect.x1), 0.5 * (rect.y0 + rect.y1)) - frame_.centre;
    }
    const double lateral = orthographic ? 1.0 : depth;  // camera-space x per pixel at depth
    const glm::dvec3 perDepth = orthographic ? glm::dvec3(0, 0, 1) : glm::dvec3(image, 1.0);  // d(camera point)/dz
    const double rhoToDepth = orthographic ? std::abs(depth) : depth;                         // −dz/drho at c

    CellRecord record;
    int frontMask = 0;
    std::array<double, 4> atReference;
    for (std::size_t k = 0; k < 4; ++k) {
        const glm::dvec3& gradient = forms.gradient[k];
        double eye = forms.eye[k];
        if (orthographic) eye *= rhoToDepth;
        atReference[k] = inFront ? 0.25 : forms.eye[k] + depth * glm::dot(gradient, perDepth);
        if (eye < 0) frontMask |= 1 << k;
        if (std::abs(eye) < leastEyeCoordinate) eye = eye < 0 ? -leastEyeCoordinate : leastEyeCoordinate;
        record.plane[k][0] = static_cast<float>(-atReference[k] / eye);
        record.plane[k][1] = static_cast<float>(-lateral * gradient.x / eye);
        record.plane[k][2] = static_cast<float>(-lateral * gradient.y / eye);
    }
    record.frontMask = static_cast<float>(frontMask);

    std::array<double, 4> s;
    for (std::size_t k = 0; k < 4; ++k) s[k] = units_.toUnit(mesh_.scalarAt(cell, static_cast<int>(k)));
    // from differences, so that a constant scalar has exactly no gradient
    const glm::dvec3 gradient =
        (s[1] - s[0]) * forms.gradient[1] + (s[2] - s[0]) * forms.gradient[2] + (s[3] - s[0]) * forms.gradient[3];
    record.scalar = static_cast<float>(s[0] + (s[1] - s[0]) * atReference[1] + (s[2] - s[0]) * atReference[2] +
                                       (s[3] - s[0]) * atReference[3]);
    record.scalarPerX = static_cast<float>(lateral * gradient.x);
    record.scalarPerY = static_cast<float>(lateral * gradient.y);
    record.scalarPerRho = static_cast<float>(-rhoToDepth * glm::dot(gradient, perDepth));
    record.scalarLow = static_cast<float>(std::min({s[0], s[1], s[2], s[3]}));
    record.scalarHigh = static_cast<float>(std::max({s[0], s[1], s[2], s[3]}));
    record.scale = static_cast<float>(depth / units_.length);

    const glm::dvec2 pixel = image + frame_.centre - frame_.sampleShift;
    record.pixelX = static_cast<float>(std::round(pixel.x));
    record.pixelY = static_cast<float>(std::round(pixel.y));
    record.fractionX = static_cast<float>(pixel.x - std::round(pixel.x));
    record.fractionY = static_cast<float>(pixel.y - std::round(pixel.y));
    return record;
}

std::array<double, 4> CellProjector::eyeCoordinates(mesh::CellIndex cell) const {
    return linearForms(cell).eye;
}

CellGradient CellProjector::gradient(mesh::CellIndex cell) const {
    // in scene units first: |g|² of a mesh of size 1e-15 leaves the range of double otherwise
    const glm::dvec3 g = mesh::cellGradient(mesh_, cell) / units_.scalarScale * units_.length;
    const double magnitude = glm::length(g);
    const glm::dvec3 normal = magnitude > 0 ? g / magnitude : glm::dvec3(0);
    return {{static_cast<float>(normal.x), static_cast<float>(normal.y), static_cast<float>(normal.z)},
            static_cast<float>(magnitude)};
}

}  // namespace tetralux::projection
