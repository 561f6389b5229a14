// SPDX-License-Identifier: Apache-2.0
/// \file
/// Parts and shape of the mesh: --blocks, --hide-blocks, --threshold, --warp, --scale.
#pragma once

#include <mesh/soup/mesh_shaping.h>

namespace CLI {
class App;
}

namespace tetralux::apps {

void addPartOptions(CLI::App& command, mesh::MeshShaping& shaping);

}  // namespace tetralux::apps
