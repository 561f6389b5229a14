// SPDX-License-Identifier: Apache-2.0
#include <mesh/io/read_mesh.h>

#include <algorithm>
#include <array>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include <mesh/io/appended_vtu.h>
#include <mesh/io/file_checks.h>
#include <mesh/io/mesh_format.h>
#include <mesh/soup/validation.h>
#include <mesh/tet/procedural_field.h>

namespace tetralux::mesh {
namespace {

const std::array formats{&rawFormat, &gmshFormat, &meditFormat, &tetgenFormat};

ReadResult generate(const ProceduralSource& source) {
    ReadResult result;
    result.mesh = sampleOnGrid(proceduralField(source.name, source.n), source.n);
    result.report.cellsRead = result.mesh.cells.size();
    result.report.cellTypes["tetrahedron"] = result.mesh.cells.size();
    return result;
}

ReadResult checked(CellSoup soup, const std::string& source, const ReadOptions& options) {
    try {
        return tetMeshFromSoup(std::move(soup), options);
    } catch (const std::runtime_error& error) {
        throw std::runtime_error(fmt::format("{}: {}", source, error.what()));
    }
}

}  // namespace

ReadResult readAs(const MeshFormat& format, const std::string& source, const ReadOptions& options) {
    return checked(format.read(source, options), source, options);
}

std::optional<ReadResult> readOwnMesh(const std::string& source, const ReadOptions& options) {
    if (const auto generated = parseProceduralSource(source)) return generate(*generated);
    if (hasExtension(source, {".vtu"})) {
        checkReadable(source);
        auto soup = readAppendedVtu(source);
        return soup ? std::optional(checked(std::move(*soup), source, options)) : std::nullopt;
    }
    const auto format =
        std::find_if(formats.begin(), formats.end(), [&](const MeshFormat* f) { return f->accepts(source); });
    return format != formats.end() ? std::optional(readAs(**format, source, options)) : std::nullopt;
}

}  // namespace tetralux::mesh
