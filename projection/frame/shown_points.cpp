// SPDX-License-Identifier: Apache-2.0
#include <projection/frame/shown_points.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <memory>

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <mesh/tet/plane_cut.h>
#include <projection/core/transfer_support.h>

namespace tetralux::projection {

namespace {

using mesh::CellIndex;
using mesh::PointIndex;

/// Of the half-spaces, the part of a → b from share `from` to share `to`; from > to: nothing.
struct ShownPart {
    double from = 0.0, to = 1.0;
};
ShownPart partWithin(const std::vector<HalfSpace>& clips, const glm::dvec3& a, const glm::dvec3& b) {
    ShownPart part;
    for (const HalfSpace& half : clips) {
        const double heightA = glm::dot(a - half.point, half.normal), heightB = glm::dot(b - half.point, half.normal);
        if (heightA < 0.0 && heightB < 0.0) return {1.0, 0.0};
        if (heightA < 0.0) part.from = std::max(part.from, heightA / (heightA - heightB));
        if (heightB < 0.0) part.to = std::min(part.to, heightA / (heightA - heightB));
    }
    return part;
}

bool within(const std::vector<HalfSpace>& clips, const glm::dvec3& p) {
    return std::all_of(clips.begin(), clips.end(),
                       [&](const HalfSpace& half) { return glm::dot(p - half.point, half.normal) >= 0.0; });
}

/// The ends of edges, as far as they lie within.
void addEdges(const std::vector<HalfSpace>& clips, std::span<const glm::dvec3> corners,
              std::vector<glm::dvec3>& points) {
    for (std::size_t i = 0; i < corners.size(); ++i)
        for (std::size_t k = i + 1; k < corners.size(); ++k) {
            const ShownPart part = partWithin(clips, corners[i], corners[k]);
            if (part.from > part.to) continue;
            points.push_back(glm::mix(corners[i], corners[k], part.from));
            points.push_back(glm::mix(corners[i], corners[k], part.to));
        }
}

/// In modes that show a scalar of every ray there is nothing that a transfer function hides.
bool hidesCells(Mode mode) {
    return !orderFree(mode) || addsUp(mode) || mode == Mode::Absorption;
}

/// Corners of shown cells; those of cells that a clipping plane meets as far as they lie within.
std::vector<glm::dvec3> cellPoints(const Scene& scene, const std::vector<HalfSpace>& clips, bool hiddenLeftOut) {
    const mesh::ScalarMesh& mesh = *scene.mesh;
    const CellVisibility visibility(mesh, scene.transferFunction, scene.settings);
    const bool hides = hiddenLeftOut && hidesCells(scene.settings.mode);
    std::vector<std::uint8_t> shown(mesh.positions.size(), 0);
    tbb::enumerable_thread_specific<std::vector<glm::dvec3>> cut;
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, mesh.cells.size()), [&](const auto& range) {
        std::vector<glm::dvec3>& points = cut.local();
        for (std::size_t cell = range.begin(); cell < range.end(); ++cell) {
            if (hides && !visibility.shows(static_cast<CellIndex>(cell))) continue;
            std::array<glm::dvec3, 4> corners;
            bool whole = true;
            for (std::size_t k = 0; k < 4; ++k) {
                corners[k] = mesh.positions[mesh.cells[cell][k]];
                whole = whole && within(clips, corners[k]);
            }
            if (!whole) {
                addEdges(clips, corners, points);
                continue;
            }
            for (const PointIndex corner : mesh.cells[cell])
                std::atomic_ref(shown[corner]).store(1, std::memory_order_relaxed);
        }
    });
    std::vector<glm::dvec3> points;
    for (const auto& part : cut) points.insert(points.end(), part.begin(), part.end());
    for (std::size_t i = 0; i < shown.size(); ++i)
        if (shown[i] != 0) points.push_back(mesh.positions[i]);
    return points;
}

void addTriangles(const mesh::SurfaceMesh& surface, const std::vector<HalfSpace>& clips,
                  std::vector<glm::dvec3>& points) {
    for (const auto& [a, b, c] : surface.triangles)
        addEdges(clips, std::array{surface.positions[a], surface.positions[b], surface.positions[c]}, points);
}

}  // namespace

std::vector<glm::dvec3> shownPoints(const Scene& scene, const SceneParts& parts, bool hiddenLeftOut) {
    std::vector<glm::dvec3> points = cellPoints(scene, parts.clips, hiddenLeftOut);
    for (const Slice& slice : parts.objects.slices)
        if (slice.opacity > 0.0)
            addTriangles(mesh::cutByPlane(*scene.mesh, slice.point, slice.normal), parts.clips, points);
    for (const OpaqueSurface& surface : parts.objects.surfaces) addTriangles(*surface.mesh, {}, points);
    return points;
}

bool isEmpty(const Image& image) {
    return std::all_of(image.pixels.begin(), image.pixels.end(),
                       [](const glm::vec4& pixel) { return pixel == glm::vec4(0.0f); });
}

std::string whyEmpty(const Scene& scene, const SceneParts& parts, const Camera& camera) {
    if (shownPoints(scene, {}).empty())
        return fmt::format(
            "the transfer function shows nothing of the scalars from {:.6g} to {:.6g}; give it extinction there",
            scene.mesh->scalarMin, scene.mesh->scalarMax);
    const std::vector<glm::dvec3> points = shownPoints(scene, parts);
    if (points.empty()) return "the clipping planes leave nothing; turn one round or move it";
    const CameraFrame frame = cameraFrame(camera);
    if (std::all_of(points.begin(), points.end(),
                    [&](const glm::dvec3& p) { return glm::dot(p - frame.eye, frame.forward) <= 0.0; }))
        return "all that shows lies behind the eye; turn the view round, or leave eye and target out";
    return "what shows lies beside the picture or between its pixels; look at the mesh's centre, or leave eye and "
           "target out";
}

}  // namespace tetralux::projection
