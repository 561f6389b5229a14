// SPDX-License-Identifier: Apache-2.0
#include <mesh/tet/volume_samples.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>

#include <tbb/parallel_for.h>

namespace tetralux::mesh {
namespace {

constexpr std::size_t wantedSamples = 100'000;
constexpr int raster = 32;

/// Squares of a raster over the bounds that a shadow along each axis covers.
class Shadows {
public:
    /// \param size of the bounds; places are told as shares of it.
    explicit Shadows(const glm::dvec3& size) : size_(size) {}

    void add(const glm::dvec3& x) {
        std::array<std::size_t, 3> place{};
        for (int axis = 0; axis < 3; ++axis) {
            const double share = size_[axis] > 0.0 ? x[axis] / size_[axis] : 0.0;
            place[static_cast<std::size_t>(axis)] =
                static_cast<std::size_t>(std::clamp(share * raster, 0.0, raster - 1.0));
        }
        for (std::size_t axis = 0; axis < 3; ++axis) {
            covered_[axis][place[(axis + 1) % 3] * raster + place[(axis + 2) % 3]] = 1;
        }
    }

    double meanArea() const {
        double sum = 0.0;
        for (int axis = 0; axis < 3; ++axis) {
            const auto& squares = covered_[static_cast<std::size_t>(axis)];
            const auto count = static_cast<double>(std::count(squares.begin(), squares.end(), 1));
            sum += count / (raster * raster) * size_[(axis + 1) % 3] * size_[(axis + 2) % 3];
        }
        return sum / 3.0;
    }

private:
    glm::dvec3 size_;
    std::array<std::array<std::uint8_t, raster * raster>, 3> covered_{};
};

/// Barycentric coordinates of sample `i` of a sequence that fills the tetrahedron evenly: the R3 sequence (Roberts
/// 2018) in the unit cube, folded (Rocchini and Cignoni 2000).
std::array<double, 4> barycentric(std::size_t i) {
    const double n = static_cast<double>(i + 1);
    const auto fraction = [](double x) { return x - std::floor(x); };
    double s = fraction(0.8191725133961645 * n);
    double t = fraction(0.6710436067037893 * n);
    double u = fraction(0.5497004779019703 * n);
    if (s + t > 1.0) {
        s = 1.0 - s;
        t = 1.0 - t;
    }
    if (t + u > 1.0) {
        const double before = u;
        u = 1.0 - s - t;
        t = 1.0 - before;
    } else if (s + t + u > 1.0) {
        const double before = u;
        u = s + t + u - 1.0;
        s = 1.0 - t - before;
    }
    return {1.0 - s - t - u, s, t, u};
}

}  // namespace

VolumeSamples sampleVolume(const ScalarMesh& mesh) {
    const glm::dvec3 size = mesh.bounds.high - mesh.bounds.low;
    const double longest = std::max({size.x, size.y, size.z});
    // In units of the longest side, so that no volume overflows or vanishes.
    const auto corner = [&](std::size_t cell, std::size_t k) {
        return (mesh.positions[mesh.cells[cell][k]] - mesh.bounds.low) / longest;
    };
    std::vector<double> volumes(mesh.cells.size());
    tbb::parallel_for(std::size_t{0}, volumes.size(), [&](std::size_t i) {
        volumes[i] = sixVolumes(corner(i, 0), corner(i, 1), corner(i, 2), corner(i, 3)) / 6.0;
    });
    const double volume = std::accumulate(volumes.begin(), volumes.end(), 0.0);
    VolumeSamples samples;
    if (!(volume > 0.0) || !std::isfinite(volume)) {
        return samples;
    }
    Shadows shadows(size / longest);
    const double spacing = volume / wantedSamples;
    double passed = 0.0;  // a sample is due whenever the volume passed exceeds another spacing
    for (std::size_t i = 0; i < volumes.size(); ++i) {
        passed += volumes[i];
        const auto due = std::min(wantedSamples, static_cast<std::size_t>(passed / spacing));
        while (samples.scalars.size() < due) {
            const std::array<double, 4> weights = barycentric(samples.scalars.size());
            glm::dvec3 x(0.0);
            double scalar = 0.0;
            for (std::size_t k = 0; k < 4; ++k) {
                x += weights[k] * corner(i, k);
                scalar += weights[k] * mesh.scalarAt(static_cast<CellIndex>(i), static_cast<int>(k));
            }
            shadows.add(x);
            samples.scalars.push_back(scalar);
        }
    }
    samples.meanWay = longest * volume / shadows.meanArea();
    return samples;
}

}  // namespace tetralux::mesh
