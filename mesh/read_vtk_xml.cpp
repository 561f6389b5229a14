// SPDX-License-Identifier: Apache-2.0
#include <vtkNew.h>
#include <vtkXMLGenericDataObjectReader.h>

#include <mesh/appended_vtu.h>
#include <mesh/file_checks.h>
#include <mesh/isolated_read.h>
#include <mesh/mesh_format.h>
#include <mesh/vtk_soup.h>

namespace tetralux::mesh {
namespace {

bool acceptsVtkXml(const std::string& source) {
    return hasExtension(source,
                        {".vtu", ".pvtu", ".vti", ".pvti", ".vtr", ".pvtr", ".vts", ".pvts", ".vtm", ".vtp", ".pvtp"});
}

CellSoup readVtkXml(const std::string& source, const ReadOptions& options) {
    checkReadable(source);
    if (hasExtension(source, {".vtu"})) {
        if (std::optional<CellSoup> soup = readAppendedVtu(source)) {
            return std::move(*soup);
        }
    }
    return readIsolated(source, [&] {
        vtkNew<vtkXMLGenericDataObjectReader> reader;
        reader->SetFileName(source.c_str());
        return soupFromReader(*reader, options.time);
    });
}

}  // namespace

const MeshFormat vtkXmlFormat{"VTK XML", ".vtu .pvtu .vti .vtr .vts .vtm", acceptsVtkXml, readVtkXml};

}  // namespace tetralux::mesh
