// SPDX-License-Identifier: Apache-2.0
#include <unistd.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <stdexcept>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include <mesh/io/mesh_format.h>
#include <mesh/io/temporary_folder.h>

namespace tetralux::mesh {
namespace {

bool acceptsStandardInput(const std::string& source) {
    return source == "-";
}

struct Beginning {
    std::string_view begins, holds;  ///< the second in the first bytes too, wherever
    const char* extension;
};

// What has no name is known by how it begins.
constexpr std::array beginnings{
    Beginning{"<", "\"UnstructuredGrid\"", ".vtu"},
    Beginning{"<", "\"ImageData\"", ".vti"},
    Beginning{"<", "\"RectilinearGrid\"", ".vtr"},
    Beginning{"<", "\"StructuredGrid\"", ".vts"},
    Beginning{"# vtk DataFile", "", ".vtk"},
    Beginning{"$MeshFormat", "", ".msh"},
    Beginning{"MeshVersionFormatted", "", ".mesh"},
    Beginning{"NRRD", "", ".nrrd"},
    Beginning{"ObjectType", "", ".mha"},
    Beginning{"CDF", "", ".e"},
    Beginning{"\x89HDF", "VTKHDF", ".vtkhdf"},
    Beginning{"\x89HDF", "CGNS", ".cgns"},
};

const char* extensionOf(std::string_view text) {
    const std::string_view head = text.substr(0, 4096);
    for (const Beginning& kind : beginnings)
        if (head.starts_with(kind.begins) && head.find(kind.holds) != std::string_view::npos) return kind.extension;
    throw std::runtime_error(
        "-: standard input holds no .vtu .vti .vtr .vts .vtk .msh .mesh .nrrd .mha .vtkhdf .cgns or Exodus; write it "
        "to "
        "a file with its own ending and give that");
}

/// Standard input can be read once, a mesh may be read several times: the copy lives as long as the program.
class StandardInput {
public:
    StandardInput() {
        if (::isatty(STDIN_FILENO) == 1)
            throw std::runtime_error("-: standard input is a terminal; pipe a mesh into it, or give a file");
        const std::string text((std::istreambuf_iterator<char>(std::cin)), {});
        if (text.empty()) throw std::runtime_error("-: standard input is empty; pipe a mesh into it, or give a file");
        path_ = folder_.path() / (std::string("mesh") + extensionOf(text));
        std::ofstream file(path_, std::ios::binary);
        if (!file.write(text.data(), static_cast<std::streamsize>(text.size())).flush())
            throw std::runtime_error(fmt::format("-: no room for standard input in {}; make some or set TMPDIR",
                                                 folder_.path().parent_path().string()));
    }
    const std::filesystem::path& path() const { return path_; }
    std::string shown(std::string message) const {
        const std::string own = path_.string();
        for (std::size_t at = message.find(own); at != std::string::npos; at = message.find(own, at + 1))
            message.replace(at, own.size(), 1, '-');
        return message;
    }

private:
    TemporaryFolder folder_{"-"};
    std::filesystem::path path_;
};

CellSoup readStandardInput(const std::string&, const ReadOptions& options) {
    static const StandardInput input;
    const std::string path = input.path().string();
    try {
        return formatOf(path)->read(path, options);
    } catch (const std::runtime_error& error) {
        throw std::runtime_error(input.shown(error.what()));
    }
}

}  // namespace

const MeshFormat standardInputFormat{"standard input", "-", acceptsStandardInput, readStandardInput};

}  // namespace tetralux::mesh
