// SPDX-License-Identifier: Apache-2.0
#include <mesh/read_mesh.h>

#include <array>
#include <stdexcept>

#include <fmt/format.h>

#include <mesh/file_checks.h>
#include <mesh/mesh_format.h>
#include <mesh/procedural_field.h>
#include <mesh/validation.h>

namespace tetralux::mesh {
namespace {

// One line per format; the first that accepts a source reads it.
const std::array formats{
    &vtkXmlFormat,   &legacyVtkFormat, &pvdFormat, &exodusFormat, &cgnsFormat,  &ensightFormat,
    &openFoamFormat, &imageFormat,     &rawFormat, &gmshFormat,   &meditFormat, &tetgenFormat,
};

std::string knownSources() {
    std::string list;
    for (const MeshFormat* format : formats) {
        list += fmt::format("{}{} ({})", list.empty() ? "" : ", ", format->name, format->sources);
    }
    return list;
}

ReadResult generate(const ProceduralSource& source) {
    ReadResult result;
    result.mesh = sampleOnGrid(proceduralField(source.name, source.n), source.n);
    result.report.cellsRead = result.mesh.cells.size();
    result.report.cellTypes["tetrahedron"] = result.mesh.cells.size();
    return result;
}

ReadResult readFile(const MeshFormat& format, const std::string& source, const ReadOptions& options) {
    CellSoup soup = format.read(source, options);
    try {
        return tetMeshFromSoup(std::move(soup), options);
    } catch (const std::runtime_error& error) {
        throw std::runtime_error(fmt::format("{}: {}", source, error.what()));
    }
}

}  // namespace

ReadResult readMesh(const std::string& source, const ReadOptions& options) {
    if (const auto generated = parseProceduralSource(source)) {
        return generate(*generated);
    }
    for (const MeshFormat* format : formats) {
        if (format->accepts(source)) {
            return readFile(*format, source, options);
        }
    }
    checkReadable(source);
    throw std::runtime_error(fmt::format("{}: unknown kind of mesh; give one of {}", source, knownSources()));
}

}  // namespace tetralux::mesh
