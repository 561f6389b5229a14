// SPDX-License-Identifier: Apache-2.0
/// \file
/// What the benchmark draws: meshes by size, transfer functions by kind, cameras on an orbit.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <glm/vec2.hpp>

#include <mesh/tet/tet_mesh.h>
#include <preint/transfer_function.h>
#include <projection/core/camera.h>
#include <projection/core/scene.h>

namespace tetralux::apps {

/// "0.15M", "150k" or "148955": a number of cells above 0. \throws std::runtime_error naming `option`.
std::uint64_t parseCellCount(const std::string& option, const std::string& text);

/// Points along an edge of the generated mesh whose 5·(n − 1)³ tetrahedra come nearest to `cells`: 32, 64, 101 for
/// 0.15, 1.25, 5 million.
int gridSizeFor(std::uint64_t cells);

/// What to read: a generated field named without a size ("bucky") once for each of `cells`, everything else as it is.
std::vector<std::string> benchSources(const std::vector<std::string>& scenes, const std::vector<std::uint64_t>& cells);

std::shared_ptr<const mesh::ScalarMesh> readBenchMesh(const std::string& source);

/// smooth    five nodes, extinction rising from 0 to 25 per edge of the unit cube: nearly all cells show
/// peaks     two isosurfaces and nothing else
/// opaque    rays end within a few cells of the surface at a twelfth of the range
/// constant  one colour, the extinction of `smooth`: needs no order
/// sparse    `smooth` where only one cell in twenty shows
/// veiled    the isosurfaces of `peaks` in a thin fog
std::vector<std::string> benchTransferFunctionNames();

/// That function for the range of this mesh, absolute. Extinction is per mesh diagonal/√3 (the edge of a cube), or per
/// eighth of the scalar's range in the scale-invariant integral. \throws std::runtime_error listing the names there
/// are.
preint::TransferFunction benchTransferFunction(const std::string& name, const mesh::ScalarMesh& mesh,
                                               projection::Mode mode);

/// The largest extinction at scalars up to and beyond the range; 0 for isosurfaces alone.
double largestExtinction(const preint::TransferFunction& function);

/// The eye of a frame: 5 degrees of an orbit from one to the next, from a three-quarter view that holds the mesh.
/// Frame −1 is the warm-up's.
projection::Camera benchCamera(const mesh::BoundingBox& bounds, const glm::ivec2& size, int frame);

}  // namespace tetralux::apps
