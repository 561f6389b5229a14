// SPDX-License-Identifier: Apache-2.0
#include <vtkMetaImageReader.h>
#include <vtkNew.h>
#include <vtkNrrdReader.h>

#include <mesh/file_checks.h>
#include <mesh/isolated_read.h>
#include <mesh/mesh_format.h>
#include <mesh/vtk_soup.h>

namespace tetralux::mesh {
namespace {

bool acceptsImage(const std::string& source) {
    return hasExtension(source, {".nrrd", ".nhdr", ".mha", ".mhd"});
}

CellSoup readImage(const std::string& source, const ReadOptions&) {
    checkReadable(source);
    return readIsolated(source, [&] {
        if (hasExtension(source, {".mha", ".mhd"})) {
            vtkNew<vtkMetaImageReader> reader;
            reader->SetFileName(source.c_str());
            return soupFromReader(*reader, std::nullopt);
        }
        vtkNew<vtkNrrdReader> reader;
        reader->SetFileName(source.c_str());
        return soupFromReader(*reader, std::nullopt);
    });
}

}  // namespace

const MeshFormat imageFormat{"image volume", ".nrrd .nhdr .mha .mhd", acceptsImage, readImage};

}  // namespace tetralux::mesh
