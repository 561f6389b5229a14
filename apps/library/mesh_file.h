// SPDX-License-Identifier: Apache-2.0
/// \file
/// Internal: what the readers made, as the library's own.
#pragma once

#include <mesh/soup/read_options.h>
#include <tetralux/io.h>

namespace tetralux::library {

/// \throws Error (BadInput)
mesh::ReadOptions checkedOptions(const ReadOptions& options);

MeshFile meshFile(mesh::ReadResult result);

}  // namespace tetralux::library
