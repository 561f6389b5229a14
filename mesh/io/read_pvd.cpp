// SPDX-License-Identifier: Apache-2.0
/// \file
/// Files that only name others, which are read one by one: VTK's reader of .pvtu wants every field in every piece, and
/// writers leave them out of empty ones.
#include <cmath>
#include <filesystem>
#include <set>
#include <stdexcept>

#include <fmt/format.h>
#include <vtkNew.h>
#include <vtkSmartPointer.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLGenericDataObjectReader.h>
#include <vtkXMLUtilities.h>

#include <mesh/io/file_checks.h>
#include <mesh/io/isolated_read.h>
#include <mesh/io/mesh_format.h>
#include <mesh/io/vtk_soup.h>

namespace tetralux::mesh {
namespace {

bool acceptsPvd(const std::string& source) {
    return hasExtension(source, {".pvd", ".pvtu"});
}

/// What a file that names others is called, and the elements that do.
struct Listing {
    const char *what, *element, *entry, *attribute;
};
constexpr Listing series{"ParaView collection", "Collection", "DataSet", "file"};
constexpr Listing pieces{"mesh in pieces", "PUnstructuredGrid", "Piece", "Source"};

bool isInPieces(const std::string& source) {
    return hasExtension(source, {".pvtu"});
}

struct Part {
    double time;
    std::string file;
};

/// The entries of a ParaView collection, every file with its time, or the pieces of a mesh in parallel.
std::vector<Part> readCollection(const std::string& source) {
    captureVtkMessages();
    const Listing& listing = isInPieces(source) ? pieces : series;
    const auto root = vtkSmartPointer<vtkXMLDataElement>::Take(vtkXMLUtilities::ReadElementFromFile(source.c_str()));
    vtkXMLDataElement* collection = root != nullptr ? root->FindNestedElementWithName(listing.element) : nullptr;
    if (collection == nullptr) {
        throw std::runtime_error(
            fmt::format("is no {} (<VTKFile type=\"{}\">); write the file again", listing.what, listing.element));
    }
    std::vector<Part> parts;
    for (int i = 0; i < collection->GetNumberOfNestedElements(); ++i) {
        vtkXMLDataElement* entry = collection->GetNestedElement(i);
        const char* file = entry->GetAttribute(listing.attribute);
        double time = 0.0;
        entry->GetScalarAttribute("timestep", time);
        if (file != nullptr && std::isfinite(time)) {
            parts.push_back({time, file});
        }
    }
    if (parts.empty()) {
        throw std::runtime_error(fmt::format("names no file; add a {} element for each", listing.entry));
    }
    return parts;
}

CellSoup readCollectionAt(const std::string& source, std::optional<double> time) {
    const std::vector<Part> parts = readCollection(source);
    std::set<double> times;
    for (const Part& part : parts) {
        times.insert(part.time);
    }
    const std::vector<double> steps(times.begin(), times.end());
    const double chosen = nearestTime(steps, time);
    CellSoup soup;
    for (const Part& part : parts) {
        if (part.time == chosen) {
            const std::filesystem::path file = std::filesystem::path(source).parent_path() / part.file;
            std::error_code failed;
            if (!std::filesystem::is_regular_file(file, failed)) {
                throw std::runtime_error(
                    fmt::format("names {}, which is not there; put it there, or name the file that is", part.file));
            }
            if (!isInPieces(source) && isInPieces(part.file)) {
                appendSoup(soup, readCollectionAt(file.string(), std::nullopt));
                continue;
            }
            vtkNew<vtkXMLGenericDataObjectReader> reader;
            reader->SetFileName(file.c_str());
            appendSoup(soup, soupFromReader(*reader, std::nullopt));
        }
    }
    if (!isInPieces(source)) {
        soup.times = steps;
    }
    return soup;
}

CellSoup readPvd(const std::string& source, const ReadOptions& options) {
    checkReadable(source);
    return readIsolated(source, [&] { return readCollectionAt(source, options.time); });
}

}  // namespace

const MeshFormat pvdFormat{"ParaView series and pieces", ".pvd .pvtu", acceptsPvd, readPvd};

}  // namespace tetralux::mesh
