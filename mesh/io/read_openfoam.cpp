// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <charconv>
#include <filesystem>
#include <map>
#include <stdexcept>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <vtkNew.h>
#include <vtkOpenFOAMReader.h>

#include <mesh/io/file_checks.h>
#include <mesh/io/isolated_read.h>
#include <mesh/io/mesh_format.h>
#include <mesh/io/number_text.h>
#include <mesh/io/temporary_folder.h>
#include <mesh/io/vtk_soup.h>
#include <mesh/soup/append_soup.h>

namespace tetralux::mesh {
namespace {

namespace fs = std::filesystem;

/// Where the case of `folder` is described, whether or not it is there.
fs::path controlFile(const std::string& folder) {
    return fs::path(folder) / "system" / "controlDict";
}

/// A ".foam" file (its content does not matter), a case's controlDict, or the folder of a case.
bool acceptsOpenFoam(const std::string& source) {
    std::error_code failed;
    return hasExtension(source, {".foam", "controlDict"}) || fs::exists(controlFile(source), failed);
}

CellSoup readCase(const std::string& file, std::optional<double> time) {
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
    return soupFromReader(*reader, time);
}

/// Entries of `folder`; none if it is no folder.
std::vector<fs::path> entriesOf(const fs::path& folder) {
    std::vector<fs::path> entries;
    std::error_code failed;
    for (fs::directory_iterator entry(folder, failed), end; !failed && entry != end; entry.increment(failed)) {
        entries.push_back(entry->path());
    }
    return entries;
}

/// The latest time of which `folder` has values; −1 without any.
double latestTime(const fs::path& folder) {
    double latest = -1.0;
    for (const fs::path& entry : entriesOf(folder)) {
        double time = 0.0;
        std::error_code failed;
        if (parseNumber(entry.filename().string(), time) == NumberText::Good && fs::is_directory(entry, failed)) {
            latest = std::max(latest, time);
        }
    }
    return latest;
}

/// The parts of a case that was decomposed and not put together again, by their numbers; none for any other.
std::vector<fs::path> processorsOf(const fs::path& folder) {
    constexpr std::string_view prefix = "processor";
    std::map<int, fs::path> parts;
    bool collated = false;
    for (const fs::path& entry : entriesOf(folder)) {
        const std::string name = entry.filename().string();
        int number = 0;
        const char* const end = name.data() + name.size();
        if (name.starts_with(prefix) && std::from_chars(name.data() + prefix.size(), end, number).ptr == end &&
            name.size() > prefix.size()) {
            parts[number] = entry;
        }
        collated = collated || name.starts_with("processors");
    }
    std::error_code failed;
    const bool together = fs::exists(folder / "constant" / "polyMesh", failed);
    if (parts.empty() && collated && !together) {
        throw std::runtime_error(
            "is decomposed, with all processors in one file, which is not read; run reconstructPar, or "
            "foamFormatConvert -fileHandler uncollated");
    }
    std::vector<fs::path> result;
    if (!parts.empty() && (!together || latestTime(parts.begin()->second) > latestTime(folder))) {
        for (const auto& [number, part] : parts) {
            result.push_back(part);
        }
    }
    return result;
}

/// Each processor has a mesh and values of its own, but the case's control files: with links to these it is a case.
CellSoup readDecomposed(const std::string& source, const fs::path& folder, const std::vector<fs::path>& processors,
                        const TemporaryFolder& links, std::optional<double> time) {
    CellSoup soup;
    for (const fs::path& processor : processors) {
        const fs::path name = processor.filename();
        fs::create_directory(links.path() / name);
        links.link(folder / "system", name / "system");
        for (const fs::path& entry : entriesOf(processor)) {
            links.link(entry, name / entry.filename());
        }
        CellSoup part;
        try {
            part = readCase((links.path() / name / "system" / "controlDict").string(), time);
        } catch (const std::runtime_error& error) {
            throw std::runtime_error(fmt::format("in {}: {}", name.string(), links.shown(error.what(), folder)));
        }
        soup.times = part.times;
        appendSoup(soup, std::move(part));
    }
    soup.notes.push_back(fmt::format("{} is decomposed: its {} processors are put together",
                                     fs::path(source).filename().string(), processors.size()));
    return soup;
}

CellSoup readOpenFoam(const std::string& source, const ReadOptions& options) {
    std::error_code failed;
    const bool isFolder = fs::is_directory(source, failed);
    const std::string file = isFolder ? controlFile(source).string() : source;
    const fs::path given = fs::absolute(source);
    const fs::path folder = isFolder                                ? given
                            : hasExtension(source, {"controlDict"}) ? given.parent_path().parent_path()
                                                                    : given.parent_path();
    const TemporaryFolder links(source);
    return readThirdParty(source, options.isolated, [&] {
        captureVtkMessages();
        const std::vector<fs::path> processors = processorsOf(folder);
        return processors.empty() ? readCase(file, options.time)
                                  : readDecomposed(source, folder, processors, links, options.time);
    });
}

}  // namespace

const MeshFormat openFoamFormat{"OpenFOAM", "case folder or .foam", acceptsOpenFoam, readOpenFoam};

}  // namespace tetralux::mesh
