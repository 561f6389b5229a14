// SPDX-License-Identifier: Apache-2.0
/// \file
/// The common kinds of .vtu file (one piece; arrays as text, base64 or appended; plain, zlib or lz4), read by many
/// threads straight into a CellSoup, without the copies of VTK's reader.
#pragma once

#include <optional>
#include <string>

#include <mesh/soup/cell_soup.h>

namespace tetralux::mesh {

/// Nothing if the file is of another kind, has polyhedra or ghosts, or anything about it is amiss: then it is for VTK's
/// reader to read it or to say what is wrong. A mesh of nothing but tetrahedra comes in the form that holds just these.
std::optional<CellSoup> readAppendedVtu(const std::string& path);

}  // namespace tetralux::mesh
