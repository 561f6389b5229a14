// SPDX-License-Identifier: Apache-2.0
/// \file
/// EnSight cases. VTK's reader takes quotes for parts of names and reads numbers as C's atof does, so it is given a
/// folder in which neither matters.
#include <algorithm>
#include <cctype>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <optional>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>

#include <fmt/format.h>
#include <vtkGenericEnSightReader.h>
#include <vtkNew.h>

#include <mesh/io/file_checks.h>
#include <mesh/io/isolated_read.h>
#include <mesh/io/mesh_format.h>
#include <mesh/io/plain_numbers.h>
#include <mesh/io/temporary_folder.h>
#include <mesh/io/text_scanner.h>
#include <mesh/io/vtk_soup.h>

namespace tetralux::mesh {
namespace {

namespace fs = std::filesystem;
constexpr const char* plainCase = "tetralux.case";

bool acceptsEnsight(const std::string& source) {
    return hasExtension(source, {".case", ".encas"});
}

/// The text of a case without quotes; spaces between them become underscores.
std::string withoutQuotes(const std::string& text) {
    std::string plain;
    bool quoted = false;
    for (const char c : text) {
        quoted = c == '\n' ? false : quoted != (c == '"');
        if (c != '"') {
            plain += quoted && c == ' ' ? '_' : c;
        }
    }
    return plain;
}

std::string withUnderscores(std::string name) {
    std::replace(name.begin(), name.end(), ' ', '_');
    return name;
}

/// VTK's reader runs on without end at a section that it does not know. \throws std::runtime_error naming its line.
void checkSections(const std::string& text) {
    static const std::set<std::string> known{"FORMAT", "GEOMETRY", "VARIABLE", "TIME", "FILE", "MATERIAL"};
    std::istringstream lines(text);
    std::string line;
    for (int number = 1; std::getline(lines, line); ++number) {
        const std::string word = line.substr(0, line.find_last_not_of(" \t\r") + 1);
        const bool isWord = !word.empty() && std::all_of(word.begin(), word.end(), [](unsigned char c) {
            return std::isalpha(c) != 0 || c == '_';
        });
        if (isWord && !known.contains(word))
            throw std::runtime_error(
                fmt::format("line {}: \"{}\" is no section that can be read; take it out, or write the rest of a file "
                            "that is cut off",
                            number, word));
    }
}

/// Whether `file` stands in the case as a whole word.
bool holdsWord(const std::string& caseText, const std::string& file) {
    constexpr const char* around = " \t\r\n\":/";
    const auto ends = [&](std::size_t at) {
        return at >= caseText.size() || std::strchr(around, caseText[at]) != nullptr;
    };
    for (std::size_t at = caseText.find(file); at != std::string::npos; at = caseText.find(file, at + 1))
        if ((at == 0 || ends(at - 1)) && ends(at + file.size())) return true;
    return false;
}

/// Whether the case names `file`, or, with the digits of its number as stars, one of a series.
bool isNamed(const std::string& caseText, const std::string& file) {
    if (holdsWord(caseText, file)) {
        return true;
    }
    std::string pattern = file;
    for (char& c : pattern) {
        c = c >= '0' && c <= '9' ? '*' : c;
    }
    return pattern != file && pattern.find("**") != std::string::npos && caseText.find('*') != std::string::npos;
}

/// The numbers of a text file as VTK reads them; nothing if it does, or if the file is binary.
std::optional<PlainText> plainFile(const fs::path& file) {
    const std::string text = readWholeFile(file.string());
    if (text.starts_with("C Binary") || text.starts_with("Fortran") || text.find('\0') != std::string::npos) {
        return std::nullopt;
    }
    try {
        return withPlainNumbers(text, {false, false, 1, 1});  // the first line is for people
    } catch (const std::runtime_error& error) {
        throw std::runtime_error(fmt::format("in {}: {}", file.filename().string(), error.what()));
    }
}

/// Fills `folder` with everything beside the case `source` under names without spaces, and with files of plain numbers.
/// \returns whether some numbers are not what they were.
bool fillFolder(const std::string& source, const TemporaryFolder& folder) {
    const std::string text = readWholeFile(source);
    checkSections(text);
    bool changed = false;
    for (const fs::directory_entry& entry : fs::directory_iterator(fs::absolute(source).parent_path())) {
        const std::string name = entry.path().filename().string();
        const bool mayHoldNumbers = entry.is_regular_file() && isNamed(text, name);
        if (const std::optional<PlainText> plain = mayHoldNumbers ? plainFile(entry.path()) : std::nullopt) {
            changed = true;
            std::ofstream(folder.path() / withUnderscores(name), std::ios::binary) << plain->text;
        } else if (entry.path().filename() != fs::path(source).filename()) {
            folder.link(entry.path(), withUnderscores(name));
        }
    }
    std::ofstream(folder.path() / plainCase, std::ios::binary) << withoutQuotes(text);
    return changed;
}

CellSoup readCase(const std::string& file, std::optional<double> time) {
    vtkNew<vtkGenericEnSightReader> reader;
    reader->SetCaseFileName(file.c_str());
    reader->ReadAllVariablesOn();
    return soupFromReader(*reader, time);
}

CellSoup readEnsight(const std::string& source, const ReadOptions& options) {
    checkReadable(source);
    const TemporaryFolder folder(source);
    return readThirdParty(source, options.isolated, [&] {
        const bool changed = fillFolder(source, folder);
        try {
            CellSoup soup = readCase((folder.path() / plainCase).string(), options.time);
            if (changed) {
                restoreNotFinite(soup);
            }
            return soup;
        } catch (const std::runtime_error& error) {
            throw std::runtime_error(folder.shown(error.what(), fs::path(source).parent_path()));
        }
    });
}

}  // namespace

const MeshFormat ensightFormat{"EnSight", ".case", acceptsEnsight, readEnsight};

}  // namespace tetralux::mesh
