// SPDX-License-Identifier: Apache-2.0
#include <mesh/tet/mesh_statistics.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>
#include <glm/geometric.hpp>

#include <mesh/tet/adjacency.h>
#include <mesh/tet/interface_checks.h>

namespace tetralux::mesh {
namespace {

using Range = tbb::blocked_range<std::size_t>;
constexpr std::size_t histogramClasses = 64;

double magnitudeAt(const Field& field, std::size_t place) {
    const std::size_t components = static_cast<std::size_t>(field.components);
    if (components == 1) {
        return field.values[place];
    }
    double norm = 0.0;
    for (std::size_t c = 0; c < components; ++c) {
        norm = std::hypot(norm, field.values[place * components + c]);
    }
    return norm;
}

/// Of `valueAt(i)`, i below `count`.
template <class ValueAt>
Histogram makeHistogram(std::size_t count, const ValueAt& valueAt) {
    double low = std::numeric_limits<double>::infinity();
    double high = -low;
    double mean = 0.0;
    std::uint64_t finite = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const double value = valueAt(i);
        if (std::isfinite(value)) {
            low = std::min(low, value);
            high = std::max(high, value);
            ++finite;
            mean += (value - mean) / static_cast<double>(finite);  // a sum could overflow
        }
    }
    Histogram result;
    result.nonFinite = count - finite;
    if (finite == 0) {
        return result;
    }
    result.low = low;
    result.high = high;
    result.mean = mean;
    if (high > low) {
        result.counts.assign(histogramClasses, 0);
        const double scale = 1.0 / (high / histogramClasses - low / histogramClasses);  // a difference could overflow
        for (std::size_t i = 0; i < count; ++i) {
            const double value = valueAt(i);
            if (std::isfinite(value)) {
                const double place = std::clamp(value * scale - low * scale, 0.0, histogramClasses - 1.0);
                ++result.counts[static_cast<std::size_t>(place)];
            }
        }
    }
    return result;
}

FieldStatistics fieldStatistics(const Field& field) {
    FieldStatistics result;
    result.name = field.name;
    result.association = field.association;
    result.components = field.components;
    result.componentNames = field.componentNames;
    result.bookkeeping = field.bookkeeping;
    result.values = field.values.size() / static_cast<std::size_t>(field.components);
    Histogram found = makeHistogram(result.values, [&](std::size_t place) { return magnitudeAt(field, place); });
    result.low = found.low;
    result.high = found.high;
    result.mean = found.mean;
    result.nonFinite = found.nonFinite;
    result.histogram = std::move(found.counts);
    return result;
}

struct VolumeSums {
    double sum = 0.0, smallest = std::numeric_limits<double>::infinity(), largest = 0.0;
};

VolumeSums sumVolumes(const TetMesh& mesh) {
    return tbb::parallel_deterministic_reduce(
        Range(0, mesh.cells.size(), 65536), VolumeSums{},
        [&](const Range& range, VolumeSums sums) {
            for (std::size_t i = range.begin(); i != range.end(); ++i) {
                const Tetrahedron& t = mesh.cells[i];
                const double volume =
                    sixVolumes(mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]], mesh.positions[t[3]]) /
                    6.0;
                sums.sum += volume;
                sums.smallest = std::min(sums.smallest, volume);
                sums.largest = std::max(sums.largest, volume);
            }
            return sums;
        },
        [](const VolumeSums& a, const VolumeSums& b) {
            return VolumeSums{a.sum + b.sum, std::min(a.smallest, b.smallest), std::max(a.largest, b.largest)};
        });
}

/// Whether `e` lies outside or on the circumsphere of the positively oriented cell, up to roundoff: it counts as
/// inside only if the determinant says so by more than its own error.
bool isOutsideCircumsphere(const TetMesh& mesh, const Tetrahedron& cell, const glm::dvec3& e) {
    std::array<glm::dvec3, 4> r;
    std::array<double, 4> lift;
    for (std::size_t k = 0; k < 4; ++k) {
        r[k] = mesh.positions[cell[k]] - e;
        lift[k] = glm::dot(r[k], r[k]);
    }
    // Shewchuk's insphere, which is negative for a point inside in our orientation of the cell.
    const auto det = [](const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
        return glm::dot(glm::cross(a, b), c);
    };
    const std::array<double, 4> terms{lift[0] * det(r[1], r[2], r[3]), -lift[1] * det(r[0], r[2], r[3]),
                                      lift[2] * det(r[0], r[1], r[3]), -lift[3] * det(r[0], r[1], r[2])};
    double size = 0.0;
    for (std::size_t k = 0; k < 4; ++k) {
        size = std::max(size, lift[k]);
    }
    const double value = terms[0] + terms[1] + terms[2] + terms[3];
    return value <= 1e-13 * size * size * std::sqrt(size);
}

std::uint64_t countDelaunayFaces(const TetMesh& mesh, const Adjacency& adjacency) {
    return tbb::parallel_reduce(
        Range(0, mesh.cells.size(), 16384), std::uint64_t{0},
        [&](const Range& range, std::uint64_t count) {
            for (std::size_t i = range.begin(); i != range.end(); ++i) {
                for (const CellIndex other : adjacency.neighbours[i]) {
                    if (other == Adjacency::noNeighbour || other < i) {
                        continue;
                    }
                    const auto& back = adjacency.neighbours[other];
                    const auto face = static_cast<std::size_t>(std::find(back.begin(), back.end(), i) - back.begin());
                    count +=
                        isOutsideCircumsphere(mesh, mesh.cells[i], mesh.positions[mesh.cells[other][face]]) ? 1 : 0;
                }
            }
            return count;
        },
        [](std::uint64_t a, std::uint64_t b) { return a + b; });
}

void countComponents(const Adjacency& adjacency, MeshStatistics& result) {
    std::vector<bool> seen(adjacency.neighbours.size(), false);
    std::vector<CellIndex> open;
    for (CellIndex seed = 0; seed < seen.size(); ++seed) {
        if (seen[seed]) {
            continue;
        }
        ++result.components;
        std::uint64_t size = 0;
        seen[seed] = true;
        open.push_back(seed);
        while (!open.empty()) {
            const CellIndex cell = open.back();
            open.pop_back();
            ++size;
            for (const CellIndex other : adjacency.neighbours[cell]) {
                if (other != Adjacency::noNeighbour && !seen[other]) {
                    seen[other] = true;
                    open.push_back(other);
                }
            }
        }
        result.largestComponent = std::max(result.largestComponent, size);
    }
}

std::uint64_t memoryOf(const TetMesh& mesh) {
    std::uint64_t bytes = mesh.positions.capacity() * sizeof(glm::dvec3) + mesh.cells.capacity() * sizeof(Tetrahedron);
    for (const Field& field : mesh.fields) {
        bytes += field.values.capacity() * sizeof(double);
    }
    return bytes;
}

}  // namespace

Histogram histogramOf(std::span<const double> values) {
    return makeHistogram(values.size(), [&](std::size_t i) { return values[i]; });
}

MeshStatistics meshStatistics(const TetMesh& mesh) {
    MeshStatistics result;
    result.points = mesh.positions.size();
    result.cells = mesh.cells.size();
    result.memoryBytes = memoryOf(mesh);
    for (const Field& field : mesh.fields) {
        result.fields.push_back(fieldStatistics(field));
    }
    if (mesh.cells.empty()) {
        return result;
    }
    result.bounds = usedBounds(mesh.positions, mesh.cells);
    const VolumeSums volumes = sumVolumes(mesh);
    result.volume = volumes.sum;
    result.smallestVolume = volumes.smallest;
    result.largestVolume = volumes.largest;
    const Adjacency adjacency = buildAdjacency(mesh.cells, mesh.positions.size());
    result.boundaryFaces = adjacency.boundaryFaces;
    for (const auto& neighbours : adjacency.neighbours) {
        result.innerFaces +=
            static_cast<std::uint64_t>(4 - std::count(neighbours.begin(), neighbours.end(), Adjacency::noNeighbour));
    }
    result.innerFaces /= 2;
    result.delaunayFaces = countDelaunayFaces(mesh, adjacency);
    countComponents(adjacency, result);
    result.defects = interfaceDefects(mesh.positions, mesh.cells, adjacency);
    return result;
}

}  // namespace tetralux::mesh
