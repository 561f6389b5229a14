// SPDX-License-Identifier: Apache-2.0
#include <vtkGenericEnSightReader.h>
#include <vtkNew.h>

#include <mesh/io/file_checks.h>
#include <mesh/io/isolated_read.h>
#include <mesh/io/mesh_format.h>
#include <mesh/io/vtk_soup.h>

namespace tetralux::mesh {
namespace {

bool acceptsEnsight(const std::string& source) {
    return hasExtension(source, {".case", ".encas"});
}

CellSoup readEnsight(const std::string& source, const ReadOptions& options) {
    checkReadable(source);
    return readIsolated(source, [&] {
        vtkNew<vtkGenericEnSightReader> reader;
        reader->SetCaseFileName(source.c_str());
        reader->ReadAllVariablesOn();
        return soupFromReader(*reader, options.time);
    });
}

}  // namespace

const MeshFormat ensightFormat{"EnSight", ".case", acceptsEnsight, readEnsight};

}  // namespace tetralux::mesh
