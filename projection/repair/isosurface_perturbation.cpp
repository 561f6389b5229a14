// SPDX-License-Identifier: Apache-2.0
#include <projection/repair/isosurface_perturbation.h>

#include <algorithm>
#include <array>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <projection/cells/edge_on_planes.h>
#include <projection/cells/point_pixel.h>
#include <projection/core/clip_region.h>
#include <projection/core/gathered.h>
#include <projection/core/transfer_support.h>
#include <projection/repair/near_line.h>

namespace tetralux::projection {

namespace {

/// Pixels from the sample to the farthest line that it may lie behind.
constexpr double perturbationDistance = 2.0 * EdgeOnPlanes::widest.x;

constexpr PixelDistances near{0.0, perturbationDistance}, exact{0.0, exactDistance};

using Corners = std::array<glm::dvec2, 3>;

/// A face as an image shows it: pixels, and scalars less the isosurface's value.
struct SeenFace {
    Corners at;
    std::array<double, 3> above;

    /// What is seen edge-on has no line of its own.
    bool edgeOn() const {
        const glm::dvec2 b = at[1] - at[0], c = at[2] - at[0];
        const double longest = std::max({glm::length(b), glm::length(c), glm::distance(at[1], at[2])});
        return !(std::abs(b.x * c.y - b.y * c.x) > 2.0 * perturbationDistance * longest);
    }
};

void addPerturbed(const SeenFace& face, const CameraFrame& frame, std::vector<std::uint32_t>& pixels) {
    std::array<glm::dvec2, 2> ends;
    std::size_t count = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t j = (i + 1) % 3;
        if ((face.above[i] < 0) == (face.above[j] < 0)) continue;
        ends[count++] = glm::mix(face.at[i], face.at[j], face.above[i] / (face.above[i] - face.above[j]));
        if (count == 2) break;
    }
    if (count == 2 && !face.edgeOn()) addNearLine(ends[0], ends[1], near, frame, pixels);
}

/// Lines of an isosurface in the faces of one cell, and its edges.
class CellPerturbations {
public:
    CellPerturbations(const Scene& scene, const CameraFrame& frame)
        : scene_(scene),
          frame_(frame),
          pixelOf_(frame),
          support_(extinctionSupport(scene.transferFunction)),
          integral_(integralOf(scene.settings.mode)),
          everyScalarShows_(scene.settings.mode == Mode::Mip || scene.settings.mode == Mode::Minimum ||
                            scene.settings.mode == Mode::Average) {
        for (const auto& source : scene.mapSources)
            if (const auto* region = dynamic_cast<const ClipRegion*>(source.get()))
                cuts_.insert(cuts_.end(), region->halfSpaces().begin(), region->halfSpaces().end());
    }

    /// Pixels that an edge of the cell, if it shows, or of what clip planes leave of it passes.
    void addEdges(mesh::CellIndex cell, PixelDistances wanted, std::vector<std::uint32_t>& pixels) const {
        std::array<glm::dvec2, 4> at;
        if (!see(scene_.mesh->cells[cell], at) || !shows(cell)) return;
        for (std::size_t i = 0; i < 4; ++i)
            for (std::size_t j = i + 1; j < 4; ++j) addNearLine(at[i], at[j], wanted, frame_, pixels);
        for (const HalfSpace& cut : cuts_) addCut(cell, cut, wanted, pixels);
    }

    void add(mesh::CellIndex cell, std::vector<std::uint32_t>& pixels) const {
        const mesh::ScalarMesh& mesh = *scene_.mesh;
        const glm::dvec2 scalars = scalarRange(mesh, cell);
        for (const preint::Isosurface& surface : scene_.transferFunction.isosurfaces) {
            if (!glsl::crossesValue(scalars.x, scalars.y, surface.value)) continue;
            std::array<glm::dvec2, 4> at;
            if (!see(mesh.cells[cell], at)) return;
            for (const auto& face : mesh::faceVertices) {
                SeenFace seen;
                for (std::size_t i = 0; i < 3; ++i) {
                    seen.at[i] = at[static_cast<std::size_t>(face[i])];
                    seen.above[i] = mesh.scalarAt(cell, face[i]) - surface.value;
                }
                addPerturbed(seen, frame_, pixels);
            }
        }
    }

private:
    /// The lines in which a plane cuts the cell's faces.
    void addCut(mesh::CellIndex cell, const HalfSpace& cut, PixelDistances wanted,
                std::vector<std::uint32_t>& pixels) const {
        std::array<glm::dvec3, 4> p;
        std::array<double, 4> above;
        for (std::size_t k = 0; k < 4; ++k) {
            p[k] = scene_.mesh->positions[scene_.mesh->cells[cell][k]];
            above[k] = glm::dot(cut.normal, p[k] - cut.point);
        }
        for (const auto& face : mesh::faceVertices) {
            std::array<glm::dvec2, 2> ends;
            std::size_t count = 0;
            for (std::size_t i = 0; i < 3 && count < 2; ++i) {
                const auto a = static_cast<std::size_t>(face[i]), b = static_cast<std::size_t>(face[(i + 1) % 3]);
                if ((above[a] < 0) == (above[b] < 0)) continue;
                const glm::dvec3 fromEye = glm::mix(p[a], p[b], above[a] / (above[a] - above[b])) - frame_.eye;
                ends[count++] = pixelOf_(fromEye, pixelOf_.depth(fromEye));
            }
            if (count == 2) addNearLine(ends[0], ends[1], wanted, frame_, pixels);
        }
    }

    bool shows(mesh::CellIndex cell) const {
        if (everyScalarShows_) return true;
        const glm::dvec2 scalars = scalarRange(*scene_.mesh, cell);
        return rangeShows(scene_.transferFunction, support_, scalars.x, scalars.y, integral_);
    }

    /// Pixel coordinates of the corners; false where one is not in front of the eye.
    bool see(const mesh::Tetrahedron& cell, std::array<glm::dvec2, 4>& at) const {
        for (std::size_t k = 0; k < 4; ++k) {
            const glm::dvec3 p = scene_.mesh->positions[cell[k]] - frame_.eye;
            const double depth = pixelOf_.depth(p);
            if (!(depth > 0)) return false;
            at[k] = pixelOf_(p, depth);
        }
        return true;
    }

    const Scene& scene_;
    const CameraFrame& frame_;
    const PointPixel pixelOf_;
    const std::vector<ShownScalars> support_;
    const preint::Integral integral_;
    const bool everyScalarShows_;
    std::vector<HalfSpace> cuts_;
};

/// What add(cell, pixels) finds, for every `step`th cell.
template <class Add>
std::vector<std::uint32_t> ofCells(const Scene& scene, mesh::CellIndex step, Add add) {
    return gathered<std::uint32_t>((scene.mesh->cells.size() + step - 1) / step, [&](std::size_t i, auto& pixels) {
        add(static_cast<mesh::CellIndex>(i) * step, pixels);
    });
}

}  // namespace

std::vector<std::uint32_t> perturbedPixels(const Scene& scene, const CameraFrame& frame) {
    if (scene.transferFunction.isosurfaces.empty()) return {};
    const CellPerturbations perturbations(scene, frame);
    return ofCells(scene, 1, [&](mesh::CellIndex cell, auto& pixels) { perturbations.add(cell, pixels); });
}

std::vector<std::uint32_t> perturbedEdgePixels(const Scene& scene, const CameraFrame& frame) {
    constexpr mesh::CellIndex sampled = 4096;
    const CellPerturbations perturbations(scene, frame);
    const mesh::CellIndex step =
        static_cast<mesh::CellIndex>(scene.mesh->cells.size()) / sampled | 1;  // odd: in no rhythm of a grid
    const auto met =
        ofCells(scene, step, [&](mesh::CellIndex cell, auto& pixels) { perturbations.addEdges(cell, exact, pixels); });
    if (met.size() < 2) return {};
    return ofCells(scene, 1, [&](mesh::CellIndex cell, auto& pixels) { perturbations.addEdges(cell, near, pixels); });
}

}  // namespace tetralux::projection
