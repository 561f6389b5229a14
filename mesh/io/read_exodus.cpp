// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cctype>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <vtkExodusIIReader.h>
#include <vtkNew.h>
#include <vtk_netcdf.h>

#include <mesh/io/file_checks.h>
#include <mesh/io/isolated_read.h>
#include <mesh/io/mesh_format.h>
#include <mesh/io/vtk_soup.h>

namespace tetralux::mesh {
namespace {

bool acceptsExodus(const std::string& source) {
    return hasExtension(source, {".e", ".ex2", ".ex2v2", ".exo", ".exii", ".exoii", ".gen", ".g"});
}

/// The numbers of nodes that VTK's reader knows for the elements whose names begin so. It takes the rows of all others
/// for shorter ones, one running into the next.
struct KnownElement {
    std::string_view name;
    std::vector<std::size_t> nodes;
};
const std::array<KnownElement, 4> knownElements{
    {{"TET", {4, 10, 15}}, {"PYR", {5, 13}}, {"WED", {6, 15, 18, 21}}, {"HEX", {8, 20, 21, 27}}}};

class NetCdfFile {
public:
    explicit NetCdfFile(const std::string& path) { good_ = nc_open(path.c_str(), NC_NOWRITE, &id_) == NC_NOERR; }
    NetCdfFile(const NetCdfFile&) = delete;
    NetCdfFile& operator=(const NetCdfFile&) = delete;
    ~NetCdfFile() {
        if (good_) {
            nc_close(id_);
        }
    }
    bool good() const { return good_; }
    std::size_t dimension(const std::string& name) const {
        int place = 0;
        std::size_t size = 0;
        const bool found = nc_inq_dimid(id_, name.c_str(), &place) == NC_NOERR;
        return found && nc_inq_dimlen(id_, place, &size) == NC_NOERR ? size : 0;
    }
    std::string text(const std::string& variable, const char* attribute) const {
        int place = 0;
        std::size_t size = 0;
        if (nc_inq_varid(id_, variable.c_str(), &place) != NC_NOERR ||
            nc_inq_attlen(id_, place, attribute, &size) != NC_NOERR || size > 1024) {
            return {};
        }
        std::string value(size, '\0');
        return nc_get_att_text(id_, place, attribute, value.data()) == NC_NOERR ? value.substr(0, value.find('\0'))
                                                                                : std::string();
    }

private:
    int id_ = 0;
    bool good_ = false;
};

/// \throws std::runtime_error naming the first block whose elements VTK's reader would scramble.
void refuseUnknownElements(const std::string& source) {
    const NetCdfFile file(source);
    if (!file.good()) {
        return;  // the reader finds that too
    }
    const std::size_t blocks = std::min<std::size_t>(file.dimension("num_el_blk"), 1'000'000);
    for (std::size_t block = 1; block <= blocks; ++block) {
        std::string name = file.text(fmt::format("connect{}", block), "elem_type");
        const std::size_t nodes = file.dimension(fmt::format("num_nod_per_el{}", block));
        std::transform(name.begin(), name.end(), name.begin(),
                       [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
        for (const KnownElement& known : knownElements) {
            const auto is = [&](std::size_t count) { return count == nodes; };
            if (name.starts_with(known.name) && nodes > 0 && std::none_of(known.nodes.begin(), known.nodes.end(), is)) {
                throw std::runtime_error(
                    fmt::format("its block {} has elements of type {} with {} nodes, which are not read; write them "
                                "with {} nodes",
                                block, name.substr(0, 32), nodes, fmt::join(known.nodes, ", ")));
            }
        }
    }
}

CellSoup readExodus(const std::string& source, const ReadOptions& options) {
    checkBeginning(source, {"CDF\x01", "CDF\x02", "CDF\x05", "\x89HDF"}, "an Exodus file (NetCDF)");
    return readThirdParty(source, options.isolated, [&] {
        refuseUnknownElements(source);
        captureVtkMessages();
        vtkNew<vtkExodusIIReader> reader;
        reader->SetFileName(source.c_str());
        reader->UpdateInformation();
        throwOnVtkError();
        reader->SetAllArrayStatus(vtkExodusIIReader::NODAL, 1);
        reader->SetAllArrayStatus(vtkExodusIIReader::ELEM_BLOCK, 1);
        for (int block = 0; block < reader->GetNumberOfElementBlockArrays(); ++block) {
            reader->SetElementBlockArrayStatus(reader->GetElementBlockArrayName(block), 1);
        }
        reader->GenerateObjectIdCellArrayOff();
        return soupFromReader(*reader, options.time);
    });
}

}  // namespace

const MeshFormat exodusFormat{"Exodus II", ".e .ex2 .exo .g", acceptsExodus, readExodus};

}  // namespace tetralux::mesh
