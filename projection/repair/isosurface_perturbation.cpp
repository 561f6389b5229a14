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
#include <projection/core/perturbed_isosurfaces.h>
#include <projection/core/transfer_support.h>
#include <projection/repair/near_line.h>

namespace tetralux::projection {

namespace {

/// Pixels from the sample to the farthest line that it may lie behind.
constexpr double perturbationDistance = 2.0 * EdgeOnPlanes::widest.x;

constexpr PixelDistances near{0.0, perturbationDistance}, exact{0.0, exactDistance};
constexpr double scalarRounding = 4 * 0x1p-24;  // of a cell's largest scalar above the field's least

/// How near an edge floats do not tell on which side a ray runs: 100 times what they round at, of the edge's length.
PixelDistances withinRounding(double pixels) {
    return {0.0, std::max(1e-5, 1e-6 * pixels)};
}

/// A face as an image shows it: corners from the eye and in pixels, and scalars less the isosurface's value.
struct SeenFace {
    std::array<glm::dvec3, 3> corners;
    std::array<glm::dvec2, 3> at;
    std::array<double, 3> above;

    /// What is seen edge-on has no line of its own.
    bool edgeOn(double distance) const {
        const glm::dvec2 b = at[1] - at[0], c = at[2] - at[0];
        const double longest = std::max({glm::length(b), glm::length(c), glm::distance(at[1], at[2])});
        return !(std::abs(b.x * c.y - b.y * c.x) > 2.0 * distance * longest);
    }
};

/// Pixels whose centre the isosurface's line in the face passes within `nearest`, or where scalars that err by
/// `scalarError` may have it.
void addPerturbed(const SeenFace& face, double nearest, double scalarError, const PointPixel& pixelOf,
                  const CameraFrame& frame, std::vector<std::uint32_t>& pixels) {
    std::array<glm::dvec2, 2> ends;
    std::size_t count = 0;
    double distance = nearest;
    for (std::size_t i = 0; i < 3 && count < 2; ++i) {
        const std::size_t j = (i + 1) % 3;
        if ((face.above[i] < 0) == (face.above[j] < 0)) continue;
        const double step = face.above[i] - face.above[j];
        const glm::dvec3 end = glm::mix(face.corners[i], face.corners[j], face.above[i] / step);
        ends[count++] = pixelOf(end, pixelOf.depth(end));
        distance =
            std::max(distance, glm::distance(face.at[i], face.at[j]) * std::min(1.0, scalarError / std::abs(step)));
    }
    if (count == 2 && !face.edgeOn(distance)) addNearLine(ends[0], ends[1], {0.0, distance}, frame, pixels);
}

/// Lines of an isosurface in the faces of one cell, and its edges.
class CellPerturbations {
public:
    CellPerturbations(const Scene& scene, const CameraFrame& frame)
        : scene_(scene),
          frame_(frame),
          pixelOf_(frame),
          isosurfaces_(withPerturbedIsosurfaces(scene, floatPerturbation).transferFunction.isosurfaces),
          support_(extinctionSupport(scene.transferFunction)),
          integral_(integralOf(scene.settings.mode)),
          everyScalarShows_(scene.settings.mode == Mode::Mip || scene.settings.mode == Mode::Minimum ||
                            scene.settings.mode == Mode::Average) {
        for (const auto& source : scene.mapSources)
            if (const auto* region = dynamic_cast<const ClipRegion*>(source.get()))
                cuts_.insert(cuts_.end(), region->halfSpaces().begin(), region->halfSpaces().end());
    }

    /// Pixels that an edge of the cell, if it shows, or of what clip planes leave of it passes at the distances that
    /// `wantedOf` gives for the edge's length in pixels.
    template <class WantedOf>
    void addEdges(mesh::CellIndex cell, const WantedOf& wantedOf, std::vector<std::uint32_t>& pixels) const {
        std::array<glm::dvec2, 4> at;
        if (!see(scene_.mesh->cells[cell], at) || !shows(cell)) return;
        double longest = 0;
        for (std::size_t i = 0; i < 4; ++i)
            for (std::size_t j = i + 1; j < 4; ++j) longest = std::max(longest, glm::distance(at[i], at[j]));
        const PixelDistances wanted = wantedOf(longest);
        for (std::size_t i = 0; i < 4; ++i)
            for (std::size_t j = i + 1; j < 4; ++j) addNearLine(at[i], at[j], wanted, frame_, pixels);
        for (const HalfSpace& cut : cuts_) addCut(cell, cut, wanted, pixels);
    }

    void add(mesh::CellIndex cell, double nearest, std::vector<std::uint32_t>& pixels) const {
        const mesh::ScalarMesh& mesh = *scene_.mesh;
        const glm::dvec2 scalars = scalarRange(mesh, cell);
        const double scalarError = scalarRounding * (scalars.y - mesh.scalarMin);
        for (const preint::Isosurface& surface : isosurfaces_) {
            if (!glsl::crossesValue(scalars.x, scalars.y, surface.value)) continue;
            std::array<glm::dvec2, 4> at;
            if (!see(mesh.cells[cell], at)) return;
            for (const auto& face : mesh::faceVertices) {
                SeenFace seen;
                for (std::size_t i = 0; i < 3; ++i) {
                    const auto corner = static_cast<std::size_t>(face[i]);
                    seen.corners[i] = mesh.positions[mesh.cells[cell][corner]] - frame_.eye;
                    seen.at[i] = at[corner];
                    seen.above[i] = mesh.scalarAt(cell, face[i]) - surface.value;
                }
                addPerturbed(seen, nearest, scalarError, pixelOf_, frame_, pixels);
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
    const std::vector<preint::Isosurface> isosurfaces_;  ///< where engines in float have them
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
    const double nearest = frame.sampleShift.x > EdgeOnPlanes::barely.x ? perturbationDistance : exactDistance;
    return ofCells(scene, 1, [&](mesh::CellIndex cell, auto& pixels) { perturbations.add(cell, nearest, pixels); });
}

std::vector<std::uint32_t> perturbedEdgePixels(const Scene& scene, const CameraFrame& frame) {
    constexpr mesh::CellIndex sampled = 4096;
    const CellPerturbations perturbations(scene, frame);
    const mesh::CellIndex step =
        static_cast<mesh::CellIndex>(scene.mesh->cells.size()) / sampled | 1;  // odd: in no rhythm of a grid
    const auto met = ofCells(scene, step, [&](mesh::CellIndex cell, auto& pixels) {
        perturbations.addEdges(
            cell, [](double) { return exact; }, pixels);
    });
    const bool inRhythm = met.size() >= 2;
    // a cell more or less is a contribution more or less, however little of it a ray meets
    if (!inRhythm && !scene.settings.contributions.perCell) return {};
    return ofCells(scene, 1, [&](mesh::CellIndex cell, auto& pixels) {
        perturbations.addEdges(
            cell, [&](double length) { return inRhythm ? near : withinRounding(length); }, pixels);
    });
}

}  // namespace tetralux::projection
