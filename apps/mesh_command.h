// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include <apps/commands.h>

namespace tetralux::apps {

/// `tetralux mesh`: becomes the program tetralux-mesher, which links the copyleft libraries, with the same arguments.
void addMeshCommand(CLI::App& program, Command& chosen);

/// Where tetralux-mesher may be, in the order of looking: the folder of this program, then those of PATH.
std::vector<std::string> mesherPlaces();

}  // namespace tetralux::apps
