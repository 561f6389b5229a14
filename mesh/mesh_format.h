// SPDX-License-Identifier: Apache-2.0
/// \file
/// What a file format is to `readMesh`: one `read_*.cpp` offers it, one line in `read_mesh.cpp` registers it.
#pragma once

#include <string>

#include <mesh/read_mesh.h>

namespace tetralux::mesh {

struct MeshFormat {
    const char* name;                                  ///< for people: "generated field"
    const char* sources;                               ///< what to give, for error messages: "bucky:N"
    bool (*accepts)(const std::string& source);        ///< by the name alone, without opening anything
    ReadResult (*read)(const std::string& source, const ReadOptions& options);
};

extern const MeshFormat generatedFormat;

}  // namespace tetralux::mesh
