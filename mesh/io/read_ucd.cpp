// SPDX-License-Identifier: Apache-2.0
#include <fstream>
#include <optional>
#include <string>

#include <vtkAVSucdReader.h>
#include <vtkNew.h>

#include <mesh/io/file_checks.h>
#include <mesh/io/isolated_read.h>
#include <mesh/io/mesh_format.h>
#include <mesh/io/plain_numbers.h>
#include <mesh/io/text_scanner.h>
#include <mesh/io/vtk_soup.h>

namespace tetralux::mesh {
namespace {

bool acceptsUcd(const std::string& source) {
    return hasExtension(source, {".inp", ".ucd"});
}

/// Abaqus calls its files ".inp" too.
bool isOfAbaqus(const std::string& source) {
    std::ifstream in(source);
    std::string line;
    while (std::getline(in, line) && (line.empty() || line[0] == '#')) {
    }
    return line.starts_with('*');
}

CellSoup readUcd(const std::string& source, const ReadOptions& options) {
    checkReadable(source);
    if (isOfAbaqus(source)) {
        return meshioFormat.read(source, options);
    }
    return readThirdParty(source, options.isolated, [&] {
        const std::string text = readWholeFile(source);
        const bool isText = text.find('\0') == std::string::npos;
        const std::optional<PlainText> plain = isText ? withPlainNumbers(text, {}) : std::nullopt;
        std::optional<MemoryFile> copy;
        if (plain) {
            copy.emplace(plain->text);
        }
        vtkNew<vtkAVSucdReader> reader;
        reader->SetFileName(copy ? copy->path().c_str() : source.c_str());
        CellSoup soup = soupFromReader(*reader, options.time);
        if (plain) {
            restoreNotFinite(soup);
        }
        return soup;
    });
}

}  // namespace

const MeshFormat ucdFormat{"AVS UCD", ".inp .ucd", acceptsUcd, readUcd};

}  // namespace tetralux::mesh
