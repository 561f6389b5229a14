// SPDX-License-Identifier: Apache-2.0
#include <vtkFLUENTReader.h>
#include <vtkNew.h>

#include <mesh/io/file_checks.h>
#include <mesh/io/isolated_read.h>
#include <mesh/io/mesh_format.h>
#include <mesh/io/vtk_soup.h>

namespace tetralux::mesh {
namespace {

bool acceptsFluent(const std::string& source) {
    return hasExtension(source, {".cas"});
}

/// Values come from the .dat beside it. VTK's reader calls it an error if that is not there; the mesh can be shown all
/// the same.
CellSoup readFluent(const std::string& source, const ReadOptions& options) {
    checkBeginning(source, {"("}, "a case of ANSYS Fluent");
    return readThirdParty(source, options.isolated, [&] {
        captureVtkMessages();
        vtkNew<vtkFLUENTReader> reader;
        reader->SetFileName(source.c_str());
        reader->UpdateInformation();
        for (int i = 0; i < reader->GetNumberOfCellArrays(); ++i) {
            reader->SetCellArrayStatus(reader->GetCellArrayName(i), 1);
        }
        reader->Update();
        CellSoup soup = soupFromVtk(reader->GetOutputDataObject(0));
        if (soup.types.empty()) {
            throwOnVtkError();
        }
        return soup;
    });
}

}  // namespace

const MeshFormat fluentFormat{"ANSYS Fluent", ".cas, with its .dat beside it", acceptsFluent, readFluent};

}  // namespace tetralux::mesh
