// SPDX-License-Identifier: Apache-2.0
#include <vtkCGNSReader.h>
#include <vtkNew.h>

#include <mesh/io/file_checks.h>
#include <mesh/io/isolated_read.h>
#include <mesh/io/mesh_format.h>
#include <mesh/io/vtk_soup.h>

namespace tetralux::mesh {
namespace {

bool acceptsCgns(const std::string& source) {
    return hasExtension(source, {".cgns"});
}

CellSoup readCgns(const std::string& source, const ReadOptions& options) {
    checkBeginning(source,
                   {"@(#)ADF",
                    "\xc0\xa8\xa3\xa9"
                    "ADF",
                    "\x89HDF"},
                   "a CGNS file (ADF or HDF5)");
    return readThirdParty(source, options.isolated, [&] {
        captureVtkMessages();
        vtkNew<vtkCGNSReader> reader;
        reader->SetFileName(source.c_str());
        reader->DoublePrecisionMeshOn();
        reader->UpdateInformation();
        throwOnVtkError();
        reader->EnableAllBases();
        reader->EnableAllFamilies();
        reader->EnableAllPointArrays();
        reader->EnableAllCellArrays();
        return soupFromReader(*reader, options.time);
    });
}

}  // namespace

const MeshFormat cgnsFormat{"CGNS", ".cgns", acceptsCgns, readCgns};

}  // namespace tetralux::mesh
