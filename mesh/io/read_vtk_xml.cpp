// SPDX-License-Identifier: Apache-2.0
#include <vtkNew.h>
#include <vtkXMLGenericDataObjectReader.h>
#include <vtkXMLPartitionedDataSetCollectionReader.h>
#include <vtkXMLPartitionedDataSetReader.h>
#include <vtkXMLUniformGridAMRReader.h>

#include <mesh/io/appended_vtu.h>
#include <mesh/io/file_checks.h>
#include <mesh/io/isolated_read.h>
#include <mesh/io/mesh_format.h>
#include <mesh/io/vtk_soup.h>

namespace tetralux::mesh {
namespace {

bool acceptsVtkXml(const std::string& source) {
    return hasExtension(source, {".vtu", ".vti", ".pvti", ".vtr", ".pvtr", ".vts", ".pvts", ".vtm", ".vtp",
                                 ".pvtp", ".vtpd", ".vtpc", ".vth", ".vthb"});
}

/// Reads what `source` holds by the reader for its extension: the generic one does not know all.
CellSoup readByExtension(const std::string& source, std::optional<double> time) {
    const auto read = [&](const auto& reader) {
        reader->SetFileName(source.c_str());
        return soupFromReader(*reader, time);
    };
    if (hasExtension(source, {".vtpd"})) {
        return read(vtkNew<vtkXMLPartitionedDataSetReader>());
    }
    if (hasExtension(source, {".vtpc"})) {
        return read(vtkNew<vtkXMLPartitionedDataSetCollectionReader>());
    }
    if (hasExtension(source, {".vth", ".vthb"})) {
        vtkNew<vtkXMLUniformGridAMRReader> reader;
        reader->SetMaximumLevelsToReadByDefault(0);  // all
        return read(reader);
    }
    return read(vtkNew<vtkXMLGenericDataObjectReader>());
}

CellSoup readVtkXml(const std::string& source, const ReadOptions& options) {
    checkReadable(source);
    if (hasExtension(source, {".vtu"})) {
        if (std::optional<CellSoup> soup = readAppendedVtu(source)) {
            return std::move(*soup);
        }
    }
    return readIsolated(source, [&] { return readByExtension(source, options.time); });
}

}  // namespace

const MeshFormat vtkXmlFormat{"VTK XML", ".vtu .vti .vtr .vts .vtm .vtpc .vth", acceptsVtkXml, readVtkXml};

}  // namespace tetralux::mesh
