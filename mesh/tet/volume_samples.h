// SPDX-License-Identifier: Apache-2.0
/// \file
/// How much of a mesh a line of sight meets, without an image.
#pragma once

#include <vector>

#include <mesh/tet/tet_mesh.h>

namespace tetralux::mesh {

struct VolumeSamples {
    std::vector<double> scalars;  ///< at points spread evenly over the volume
    /// Mean length of the way through the mesh of lines along the axes that meet it, mesh units: its volume over the
    /// mean area of its three shadows, which are taken on a raster of 32 × 32 over the bounds.
    double meanWay = 0.0;
};

/// About 100,000 samples, the same ones whatever the units; none if the cells are too flat to have a volume.
VolumeSamples sampleVolume(const ScalarMesh& mesh);

}  // namespace tetralux::mesh
