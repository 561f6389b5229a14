// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <mesh/io/read_mesh.h>

namespace CLI {
class App;
}

namespace tetralux::apps {

/// Adds the options that say how a mesh is read, the same for every subcommand that reads one.
void addReadOptions(CLI::App& command, mesh::ReadOptions& options);

}  // namespace tetralux::apps
