// SPDX-License-Identifier: Apache-2.0
#include <optional>
#include <string>

#include <vtkGenericDataObjectReader.h>
#include <vtkNew.h>

#include <mesh/io/file_checks.h>
#include <mesh/io/isolated_read.h>
#include <mesh/io/mesh_format.h>
#include <mesh/io/plain_numbers.h>
#include <mesh/io/text_scanner.h>
#include <mesh/io/vtk_soup.h>

namespace tetralux::mesh {
namespace {

bool acceptsLegacyVtk(const std::string& source) {
    return hasExtension(source, {".vtk"});
}

/// The declared type of an array in a line of a legacy file, made double: "POINTS 8 float".
std::string withDoubles(std::string text) {
    static const std::string single = "float";
    for (std::size_t at = text.find(single); at != std::string::npos; at = text.find(single, at + 1)) {
        const bool begins = at > 0 && (text[at - 1] == ' ' || text[at - 1] == '\t');
        const std::size_t end = at + single.size();
        if (begins && (end == text.size() || text[end] == '\n' || text[end] == '\r' || text[end] == ' ')) {
            text.replace(at, single.size(), "double");
        }
    }
    return text;
}

/// A text file with the numbers that VTK reads; nothing if that is what `source` is, or if it is binary.
std::optional<std::string> plainLegacy(const std::string& source) {
    const std::string text = readWholeFile(source);
    TextScanner scan(text, source, '\0');
    scan.restOfLine();
    scan.restOfLine();
    const std::string_view kind = scan.restOfLine();
    if (!kind.starts_with("ASCII") && !kind.starts_with("ascii")) {
        return std::nullopt;
    }
    constexpr std::size_t headLines = 3;
    std::optional<PlainText> plain = withPlainNumbers(text, {false, false, 1, headLines});
    if (!plain) {
        return std::nullopt;
    }
    return plain->beyondFloat ? withDoubles(std::move(plain->text)) : std::move(plain->text);
}

CellSoup readLegacyVtk(const std::string& source, const ReadOptions& options) {
    checkReadable(source);
    return readThirdParty(source, options.isolated, [&] {
        vtkNew<vtkGenericDataObjectReader> reader;
        const std::optional<std::string> plain = plainLegacy(source);
        if (plain) {
            reader->ReadFromInputStringOn();
            reader->SetInputString(*plain);
        } else {
            reader->SetFileName(source.c_str());
        }
        reader->ReadAllScalarsOn();
        reader->ReadAllVectorsOn();
        reader->ReadAllNormalsOn();
        reader->ReadAllTensorsOn();
        reader->ReadAllColorScalarsOn();
        reader->ReadAllTCoordsOn();
        reader->ReadAllFieldsOn();
        CellSoup soup = soupFromReader(*reader, std::nullopt);
        if (plain) {
            restoreNotFinite(soup);
        }
        return soup;
    });
}

}  // namespace

const MeshFormat legacyVtkFormat{"legacy VTK", ".vtk", acceptsLegacyVtk, readLegacyVtk};

}  // namespace tetralux::mesh
