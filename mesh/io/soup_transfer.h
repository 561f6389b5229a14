// SPDX-License-Identifier: Apache-2.0
/// \file
/// A CellSoup through an open file, between two processes of this machine.
#pragma once

#include <string>

#include <mesh/soup/cell_soup.h>

namespace tetralux::mesh {

/// Writes at the file's position. \returns false if the system refused.
bool writeSoup(int file, const CellSoup& soup);

/// Reads what `writeSoup` wrote. \returns false if the file ends early.
bool readSoup(int file, CellSoup& soup);

}  // namespace tetralux::mesh
