// SPDX-License-Identifier: Apache-2.0
/// \file
/// From a file, or the name of a generated field, to a checked mesh.
#pragma once

#include <optional>
#include <string>

#include <mesh/soup/read_options.h>
#include <mesh/tet/select_scalar.h>

namespace tetralux::mesh {

/// Reads `source`: a file of any registered format or a generated field such as "bucky:32".
/// \throws std::runtime_error naming the source, what is wrong and what would mend it.
ReadResult readMesh(const std::string& source, const ReadOptions& options = {});

/// The same by the readers that need no VTK: generated fields, the common kinds of .vtu, Gmsh, MEDIT, TetGen, raw
/// voxels. Nothing if the source is of none of these.
std::optional<ReadResult> readOwnMesh(const std::string& source, const ReadOptions& options = {});

}  // namespace tetralux::mesh
