// SPDX-License-Identifier: Apache-2.0
#include <vtkExodusIIReader.h>
#include <vtkNew.h>

#include <mesh/io/file_checks.h>
#include <mesh/io/isolated_read.h>
#include <mesh/io/mesh_format.h>
#include <mesh/io/vtk_soup.h>

namespace tetralux::mesh {
namespace {

bool acceptsExodus(const std::string& source) {
    return hasExtension(source, {".e", ".ex2", ".ex2v2", ".exo", ".exii", ".exoii", ".gen", ".g"});
}

CellSoup readExodus(const std::string& source, const ReadOptions& options) {
    checkBeginning(source, {"CDF\x01", "CDF\x02", "CDF\x05", "\x89HDF"}, "an Exodus file (NetCDF)");
    return readIsolated(source, [&] {
        captureVtkMessages();
        vtkNew<vtkExodusIIReader> reader;
        reader->SetFileName(source.c_str());
        reader->UpdateInformation();
        throwOnVtkError();
        reader->SetAllArrayStatus(vtkExodusIIReader::NODAL, 1);
        reader->SetAllArrayStatus(vtkExodusIIReader::ELEM_BLOCK, 1);
        for (int block = 0; block < reader->GetNumberOfElementBlockArrays(); ++block) {
            reader->SetElementBlockArrayStatus(reader->GetElementBlockArrayName(block), 1);
        }
        reader->GenerateObjectIdCellArrayOff();
        return soupFromReader(*reader, options.time);
    });
}

}  // namespace

const MeshFormat exodusFormat{"Exodus II", ".e .ex2 .exo .g", acceptsExodus, readExodus};

}  // namespace tetralux::mesh
