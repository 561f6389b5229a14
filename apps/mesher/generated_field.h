// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <mesh/tet/tet_mesh.h>

namespace tetralux::mesher {

/// A point field by name or formula: "x", "y", "z", "radius" (from the centre of the bounding box), "distance" (to the
/// mesh's boundary, all in mesh units), or a formula of these and of the mesh's point fields, "x^2 + sin(y)" (the
/// syntax is ExprTk's, as in ParaView's calculator), which is then called "formula", or "NAME=FORMULA". Takes the place
/// of a field of the same name. \throws std::runtime_error when the formula cannot be understood.
void addGeneratedField(mesh::TetMesh& mesh, const std::string& specification);

}  // namespace tetralux::mesher
