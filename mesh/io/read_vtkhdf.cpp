// SPDX-License-Identifier: Apache-2.0
#include <vtkHDFReader.h>
#include <vtkNew.h>

#include <mesh/io/file_checks.h>
#include <mesh/io/isolated_read.h>
#include <mesh/io/mesh_format.h>
#include <mesh/io/vtk_soup.h>

namespace tetralux::mesh {
namespace {

bool acceptsVtkHdf(const std::string& source) {
    return hasExtension(source, {".vtkhdf"});
}

CellSoup readVtkHdf(const std::string& source, const ReadOptions& options) {
    checkBeginning(source, {"\x89HDF"}, "a VTKHDF file (HDF5)");
    return readIsolated(source, [&] {
        captureVtkMessages();
        vtkNew<vtkHDFReader> reader;
        reader->SetFileName(source.c_str());
        return soupFromReader(*reader, options.time);
    });
}

}  // namespace

const MeshFormat vtkHdfFormat{"VTKHDF", ".vtkhdf", acceptsVtkHdf, readVtkHdf};

}  // namespace tetralux::mesh
