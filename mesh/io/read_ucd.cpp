// SPDX-License-Identifier: Apache-2.0
#include <fstream>
#include <stdexcept>
#include <string>

#include <fmt/format.h>
#include <vtkAVSucdReader.h>
#include <vtkNew.h>

#include <mesh/io/file_checks.h>
#include <mesh/io/isolated_read.h>
#include <mesh/io/mesh_format.h>
#include <mesh/io/vtk_soup.h>

namespace tetralux::mesh {
namespace {

bool acceptsUcd(const std::string& source) {
    return hasExtension(source, {".inp", ".ucd"});
}

/// Abaqus calls its files ".inp" too.
void refuseAbaqus(const std::string& source) {
    std::ifstream in(source);
    std::string line;
    while (std::getline(in, line) && (line.empty() || line[0] == '#')) {
    }
    if (line.starts_with('*')) {
        throw std::runtime_error(fmt::format(
            "{}: is a file of Abaqus, which is not read; convert it to .vtu or Gmsh's .msh (meshio, Gmsh)", source));
    }
}

CellSoup readUcd(const std::string& source, const ReadOptions& options) {
    checkReadable(source);
    refuseAbaqus(source);
    return readIsolated(source, [&] {
        vtkNew<vtkAVSucdReader> reader;
        reader->SetFileName(source.c_str());
        return soupFromReader(*reader, options.time);
    });
}

}  // namespace

const MeshFormat ucdFormat{"AVS UCD", ".inp .ucd", acceptsUcd, readUcd};

}  // namespace tetralux::mesh
