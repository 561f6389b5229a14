// SPDX-License-Identifier: Apache-2.0
#include <vtkGenericDataObjectReader.h>
#include <vtkNew.h>

#include <mesh/io/file_checks.h>
#include <mesh/io/isolated_read.h>
#include <mesh/io/mesh_format.h>
#include <mesh/io/vtk_soup.h>

namespace tetralux::mesh {
namespace {

bool acceptsLegacyVtk(const std::string& source) {
    return hasExtension(source, {".vtk"});
}

CellSoup readLegacyVtk(const std::string& source, const ReadOptions&) {
    checkReadable(source);
    return readIsolated(source, [&] {
        vtkNew<vtkGenericDataObjectReader> reader;
        reader->SetFileName(source.c_str());
        reader->ReadAllScalarsOn();
        reader->ReadAllVectorsOn();
        reader->ReadAllNormalsOn();
        reader->ReadAllTensorsOn();
        reader->ReadAllColorScalarsOn();
        reader->ReadAllTCoordsOn();
        reader->ReadAllFieldsOn();
        return soupFromReader(*reader, std::nullopt);
    });
}

}  // namespace

const MeshFormat legacyVtkFormat{"legacy VTK", ".vtk", acceptsLegacyVtk, readLegacyVtk};

}  // namespace tetralux::mesh
