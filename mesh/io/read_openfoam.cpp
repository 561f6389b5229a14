// SPDX-License-Identifier: Apache-2.0
#include <filesystem>

#include <vtkNew.h>
#include <vtkOpenFOAMReader.h>

#include <mesh/io/file_checks.h>
#include <mesh/io/isolated_read.h>
#include <mesh/io/mesh_format.h>
#include <mesh/io/vtk_soup.h>

namespace tetralux::mesh {
namespace {

/// Where the case of `folder` is described, whether or not it is there.
std::filesystem::path controlFile(const std::string& folder) {
    return std::filesystem::path(folder) / "system" / "controlDict";
}

/// A ".foam" file (its content does not matter), a case's controlDict, or the folder of a case.
bool acceptsOpenFoam(const std::string& source) {
    std::error_code failed;
    return hasExtension(source, {".foam", "controlDict"}) || std::filesystem::exists(controlFile(source), failed);
}

CellSoup readOpenFoam(const std::string& source, const ReadOptions& options) {
    std::error_code failed;
    const bool isFolder = std::filesystem::is_directory(source, failed);
    const std::string file = isFolder ? controlFile(source).string() : source;
    return readIsolated(source, [&] {
        captureVtkMessages();
        vtkNew<vtkOpenFOAMReader> reader;
        reader->SetFileName(file.c_str());
        reader->DecomposePolyhedraOff();
        reader->CreateCellToPointOff();
        reader->UpdateInformation();
        throwOnVtkError();
        reader->DisableAllPatchArrays();
        reader->SetPatchArrayStatus("internalMesh", 1);
        reader->EnableAllCellArrays();
        reader->EnableAllPointArrays();
        return soupFromReader(*reader, options.time);
    });
}

}  // namespace

const MeshFormat openFoamFormat{"OpenFOAM", "case folder or .foam", acceptsOpenFoam, readOpenFoam};

}  // namespace tetralux::mesh
