// SPDX-License-Identifier: Apache-2.0
#include <map>

#include <vtkNew.h>
#include <vtkXMLGenericDataObjectReader.h>
#include <vtkXMLImageDataReader.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLRectilinearGridReader.h>
#include <vtkXMLStructuredGridReader.h>
#include <vtkXMLUniformGridAMRReader.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <mesh/io/appended_vtu.h>
#include <mesh/io/file_checks.h>
#include <mesh/io/isolated_read.h>
#include <mesh/io/mesh_format.h>
#include <mesh/io/plain_numbers.h>
#include <mesh/io/vtk_soup.h>
#include <mesh/io/vtk_xml_text.h>
#include <mesh/soup/append_soup.h>

namespace tetralux::mesh {
namespace {

bool acceptsVtkXml(const std::string& source) {
    return hasExtension(source, {".vtu", ".vti", ".vtr", ".vts", ".vtp", ".vth", ".vthb"});
}

/// Reads what `source` holds by the reader for its extension: the generic one does not know all.
CellSoup readByExtension(const std::string& source, std::optional<double> time) {
    if (hasExtension(source, {".vth", ".vthb"})) {
        vtkNew<vtkXMLUniformGridAMRReader> reader;
        reader->SetMaximumLevelsToReadByDefault(0);  // all
        reader->SetFileName(source.c_str());
        return soupFromReader(*reader, time);
    }
    vtkNew<vtkXMLGenericDataObjectReader> reader;
    reader->SetFileName(source.c_str());
    return soupFromReader(*reader, time);
}

template <class Reader>
CellSoup readString(const std::string& text, std::optional<double> time) {
    vtkNew<Reader> reader;
    reader->ReadFromInputStringOn();
    reader->SetInputString(text);
    CellSoup soup = soupFromReader(*reader, time);
    restoreNotFinite(soup);
    return soup;
}

CellSoup readFiles(const VtkXmlText& plain, std::optional<double> time) {
    static const std::map<std::string, CellSoup (*)(const std::string&, std::optional<double>)> readers{
        {"UnstructuredGrid", readString<vtkXMLUnstructuredGridReader>},
        {"ImageData", readString<vtkXMLImageDataReader>},
        {"RectilinearGrid", readString<vtkXMLRectilinearGridReader>},
        {"StructuredGrid", readString<vtkXMLStructuredGridReader>},
        {"PolyData", readString<vtkXMLPolyDataReader>}};
    const auto reader = readers.find(plain.kind);
    CellSoup soup;
    for (const std::string& file : plain.files) {
        if (reader != readers.end()) {
            appendSoup(soup, reader->second(file, time));
        }
    }
    return soup;
}

CellSoup readVtkXml(const std::string& source, const ReadOptions& options) {
    checkReadable(source);
    if (hasExtension(source, {".vtu"})) {
        if (std::optional<CellSoup> soup = readAppendedVtu(source)) {
            return std::move(*soup);
        }
    }
    return readThirdParty(source, options.isolated, [&] {
        const VtkXmlText plain = plainVtkXml(source);
        return plain.files.empty() ? readByExtension(source, options.time) : readFiles(plain, options.time);
    });
}

}  // namespace

const MeshFormat vtkXmlFormat{"VTK XML", ".vtu .vti .vtr .vts .vth", acceptsVtkXml, readVtkXml};

}  // namespace tetralux::mesh
