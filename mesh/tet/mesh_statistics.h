// SPDX-License-Identifier: Apache-2.0
/// \file
/// What can be said of a checked mesh: for `tetralux info`.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include <mesh/tet/field.h>
#include <mesh/tet/mesh_report.h>
#include <mesh/tet/tet_mesh.h>

namespace tetralux::mesh {

/// Of finite values, in equal classes from low to high.
struct Histogram {
    double low = 0.0, high = 0.0, mean = 0.0;  ///< zeros if there is no finite value
    std::uint64_t nonFinite = 0;
    std::vector<std::uint64_t> counts;  ///< 64 classes; empty if low == high
};
Histogram histogramOf(std::span<const double> values);

/// Values are those of the field, or the magnitudes of its vectors. Non-finite ones are only counted.
struct FieldStatistics {
    std::string name;
    Association association = Association::Point;
    int components = 1;
    std::vector<std::string> componentNames;  ///< as the file calls them; empty if it does not
    bool bookkeeping = false;
    double low = 0.0, high = 0.0, mean = 0.0;  ///< of the finite values; zeros if there is none
    std::uint64_t values = 0;                  ///< points or cells
    std::uint64_t nonFinite = 0;
    std::vector<std::uint64_t> histogram;  ///< 64 equal classes from low to high; empty if low == high
};

struct MeshStatistics {
    std::uint64_t points = 0, cells = 0;
    BoundingBox bounds;   ///< mesh units
    double volume = 0.0;  ///< sum over cells, mesh units cubed
    double smallestVolume = 0.0, largestVolume = 0.0;
    std::uint64_t innerFaces = 0, boundaryFaces = 0;
    std::uint64_t delaunayFaces = 0;  ///< inner faces with neither opposite point inside the other cell's circumsphere
    std::uint64_t components = 0;     ///< sets of cells connected through faces
    std::uint64_t largestComponent = 0;  ///< its cells
    /// By `interface_checks.h`; places are cells of the mesh.
    std::map<Defect, DefectCount> defects;
    std::uint64_t memoryBytes = 0;  ///< of the mesh's arrays
    std::vector<FieldStatistics> fields;

    /// Share of inner faces that are Delaunay; 1 without inner faces.
    double delaunayShare() const {
        return innerFaces == 0 ? 1.0 : static_cast<double>(delaunayFaces) / static_cast<double>(innerFaces);
    }
};

MeshStatistics meshStatistics(const TetMesh& mesh);

}  // namespace tetralux::mesh
