// SPDX-License-Identifier: Apache-2.0
/// \file
/// Files that only name others, which are read one by one, each by its own reader, and put together by the names of
/// their fields: writers leave fields out of some pieces and blocks.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>
#include <set>
#include <stdexcept>
#include <tuple>

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <mesh/io/file_checks.h>
#include <mesh/io/mesh_format.h>
#include <mesh/io/nearest_time.h>
#include <mesh/io/number_text.h>
#include <mesh/io/xml_tags.h>
#include <mesh/soup/append_soup.h>
#include <mesh/soup/block_names.h>

namespace tetralux::mesh {
namespace {

/// What a file that names others is called, and the elements that do.
struct Listing {
    std::vector<const char*> extensions;
    const char* what;
    std::vector<std::string> elements;  ///< the first that a file of the kind must have
    const char *entry, *attribute;
    bool isSeries;
};

const std::vector<Listing>& listings() {
    static const std::vector<Listing> all{
        {{".pvd"}, "ParaView collection", {"Collection"}, "DataSet", "file", true},
        {{".pvtu", ".pvti", ".pvtr", ".pvts", ".pvtp"},
         "mesh in pieces",
         {"PUnstructuredGrid", "PImageData", "PRectilinearGrid", "PStructuredGrid", "PPolyData"},
         "Piece",
         "Source",
         false},
        {{".vtm", ".vtpd", ".vtpc"},
         "mesh in blocks",
         {"vtkMultiBlockDataSet", "vtkPartitionedDataSet", "vtkPartitionedDataSetCollection", "vtkMultiPieceDataSet",
          "vtkHierarchicalDataSet", "vtkMultiGroupDataSet"},
         "DataSet",
         "file",
         false},
    };
    return all;
}

const Listing* listingOf(const std::string& source) {
    const auto found = std::find_if(listings().begin(), listings().end(),
                                    [&](const Listing& l) { return hasExtension(source, l.extensions); });
    return found != listings().end() ? &*found : nullptr;
}

bool acceptsListing(const std::string& source) {
    return listingOf(source) != nullptr;
}

struct Entry {
    double time = 0.0;
    std::string file;
    std::tuple<std::string, std::string, std::string> part;  ///< which part of the mesh of its time
};

class OpenListing {
public:
    explicit OpenListing(const std::string& path) : file_(::open(path.c_str(), O_RDONLY | O_CLOEXEC)) {}
    OpenListing(const OpenListing&) = delete;
    OpenListing& operator=(const OpenListing&) = delete;
    ~OpenListing() {
        if (file_ >= 0) {
            ::close(file_);
        }
    }
    int get() const { return file_; }

private:
    int file_;
};

/// Whether the file names grids of which finer ones stand for parts of coarser ones: to know these takes VTK.
bool holdsAmr(const std::string& source) {
    const OpenListing file(source);
    XmlTags tags(file.get());
    std::optional<XmlTag> tag = tags.next();
    while (tag && tag->name != "VTKFile") {
        tag = tags.next();
    }
    const std::string type = tag ? tag->get("type") : "";
    return type == "vtkHierarchicalBoxDataSet" || type == "vtkOverlappingAMR" || type == "vtkNonOverlappingAMR";
}

std::vector<Entry> readEntries(const std::string& source, const Listing& listing) {
    const OpenListing file(source);
    XmlTags tags(file.get());
    bool isOfTheKind = false;
    std::vector<Entry> entries;
    while (const std::optional<XmlTag> tag = tags.next()) {
        isOfTheKind = isOfTheKind ||
                      std::find(listing.elements.begin(), listing.elements.end(), tag->name) != listing.elements.end();
        const std::string file_ = tag->get(listing.attribute);
        Entry entry;
        if (tag->name == listing.entry && !file_.empty() &&
            parseNumber(tag->get("timestep", "0"), entry.time) == NumberText::Good && std::isfinite(entry.time)) {
            entry.file = file_;
            entry.part = {tag->get("part", "0"), tag->get("group"), tag->get("name")};
            entries.push_back(std::move(entry));
        }
    }
    if (!isOfTheKind) {
        throw std::runtime_error(fmt::format("{}: is no {} (it has no <{}>); write the file again", source,
                                             listing.what, listing.elements.front()));
    }
    if (entries.empty()) {
        throw std::runtime_error(fmt::format("{}: names no file; add a {} element for each", source, listing.entry));
    }
    return entries;
}

/// A run that starts again from an earlier time appends to its series: of two files for one part at one time the later
/// counts. \returns what that left out, as lines for people.
std::vector<std::string> dropReplaced(std::vector<Entry>& entries) {
    std::vector<Entry> kept;
    std::set<std::tuple<double, std::tuple<std::string, std::string, std::string>>> seen;
    std::vector<std::string> notes;
    std::size_t replaced = 0;
    constexpr std::size_t notesShown = 5;
    for (auto entry = entries.rbegin(); entry != entries.rend(); ++entry) {
        if (seen.emplace(entry->time, entry->part).second) {
            kept.push_back(*entry);
            continue;
        }
        const auto later = std::find_if(kept.begin(), kept.end(), [&](const Entry& other) {
            return other.time == entry->time && other.part == entry->part;
        });
        if (later->file != entry->file && replaced++ < notesShown) {
            notes.push_back(fmt::format("two files for time {}: the later one, {}, counts and {} does not", entry->time,
                                        later->file, entry->file));
        }
    }
    if (replaced > notesShown) {
        notes.push_back(fmt::format("and {} more files for which a later one counts", replaced - notesShown));
    }
    std::reverse(kept.begin(), kept.end());
    std::reverse(notes.begin(), notes.end());
    entries = std::move(kept);
    return notes;
}

/// Listings may name listings, but not forever.
class Depth {
public:
    explicit Depth(const std::string& source) {
        constexpr int deepest = 16;
        if (++depth() > deepest) {
            --depth();
            throw std::runtime_error(
                fmt::format("{}: files name each other in a circle; name those that hold the mesh", source));
        }
    }
    Depth(const Depth&) = delete;
    Depth& operator=(const Depth&) = delete;
    ~Depth() { --depth(); }

private:
    static int& depth() {
        thread_local int value = 0;
        return value;
    }
};

void appendFile(const std::string& source, const Entry& entry, const ReadOptions& options, CellSoup& soup,
                std::optional<double> block = {}) {
    const std::string& name = entry.file;
    const std::string file = (std::filesystem::path(source).parent_path() / name).string();
    std::error_code failed;
    if (!std::filesystem::is_regular_file(file, failed)) {
        throw std::runtime_error(
            fmt::format("{}: names {}, which is not there; put it there, or name the file that is", source, name));
    }
    if (const MeshFormat* const format = formatOf(file)) {
        CellSoup part = format->read(file, options);
        if (block) nameBlock(part, *block, std::get<2>(entry.part));
        appendSoup(soup, std::move(part));
    } else {
        soup.notes.push_back(fmt::format("{} is no mesh and is left out", name));
    }
}

CellSoup readListing(const std::string& source, const ReadOptions& options) {
    checkReadable(source);
    const Depth depth(source);
    const Listing& listing = *listingOf(source);
    if (holdsAmr(source)) {
        return vtkXmlFormat.read(source, options);
    }
    std::vector<Entry> entries = readEntries(source, listing);
    CellSoup soup;
    if (!listing.isSeries) {
        const bool named = entries.size() > 1 && std::any_of(entries.begin(), entries.end(), [](const Entry& entry) {
                               return !std::get<2>(entry.part).empty();
                           });
        double number = 0.0;
        for (const Entry& entry : entries) {
            ++number;
            appendFile(source, entry, options, soup, named ? std::optional(number) : std::nullopt);
        }
        return soup;
    }
    soup.notes = dropReplaced(entries);
    std::set<double> times;
    for (const Entry& entry : entries) {
        times.insert(entry.time);
    }
    const std::vector<double> steps(times.begin(), times.end());
    const double chosen = nearestTime(steps, options.time);
    for (const Entry& entry : entries) {
        if (entry.time == chosen) {
            appendFile(source, entry, {}, soup);
        }
    }
    soup.times = steps;
    return soup;
}

}  // namespace

const MeshFormat listingFormat{"ParaView series, pieces and blocks", ".pvd .pvtu .pvti .vtm .vtpc", acceptsListing,
                               readListing};

}  // namespace tetralux::mesh
