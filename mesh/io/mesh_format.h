// SPDX-License-Identifier: Apache-2.0
/// \file
/// What a file format is to `readMesh`: one `read_*.cpp` offers it, one line in `read_mesh.cpp` registers it.
#pragma once

#include <string>

#include <mesh/io/read_mesh.h>
#include <mesh/soup/cell_soup.h>

namespace tetralux::mesh {

struct MeshFormat {
    const char* name;                            ///< for people: "VTK XML"
    const char* sources;                         ///< what to give, for error messages: ".vtu .pvtu"
    bool (*accepts)(const std::string& source);  ///< by the name alone, without opening anything
    /// \throws std::runtime_error naming the source, what is wrong and what would mend it.
    CellSoup (*read)(const std::string& source, const ReadOptions& options);
};

/// The format that accepts `source`; nullptr if none does. (Of all readers.)
const MeshFormat* formatOf(const std::string& source);

/// A checked mesh by that format. \throws std::runtime_error naming the source
ReadResult readAs(const MeshFormat& format, const std::string& source, const ReadOptions& options);

extern const MeshFormat vtkXmlFormat;
extern const MeshFormat legacyVtkFormat;
extern const MeshFormat vtkHdfFormat;
extern const MeshFormat listingFormat;
extern const MeshFormat exodusFormat;
extern const MeshFormat cgnsFormat;
extern const MeshFormat ensightFormat;
extern const MeshFormat openFoamFormat;
extern const MeshFormat ucdFormat;
extern const MeshFormat fluentFormat;
extern const MeshFormat imageFormat;
extern const MeshFormat rawFormat;
extern const MeshFormat gmshFormat;
extern const MeshFormat meditFormat;
extern const MeshFormat tetgenFormat;
extern const MeshFormat gzipFormat;
extern const MeshFormat meshioFormat;
extern const MeshFormat standardInputFormat;

}  // namespace tetralux::mesh
