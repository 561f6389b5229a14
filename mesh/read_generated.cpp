// SPDX-License-Identifier: Apache-2.0
#include <mesh/mesh_format.h>
#include <mesh/procedural_field.h>

namespace tetralux::mesh {
namespace {

bool acceptsGenerated(const std::string& source) { return parseProceduralSource(source).has_value(); }

ReadResult readGenerated(const std::string& source, const ReadOptions&) {
    const ProceduralSource parsed = *parseProceduralSource(source);
    ReadResult result;
    result.mesh = sampleOnGrid(proceduralField(parsed.name, parsed.n), parsed.n);
    result.report.cellsRead = result.mesh.cells.size();
    result.report.cellTypes["tetrahedron"] = result.mesh.cells.size();
    return result;
}

}  // namespace

const MeshFormat generatedFormat{"generated field", "bucky:N, coulomb:N, marschner-lobb:N, hydrogen:N", acceptsGenerated,
                                 readGenerated};

}  // namespace tetralux::mesh
