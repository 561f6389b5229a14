// SPDX-License-Identifier: Apache-2.0
#include <mesh/read_mesh.h>

#include <array>
#include <filesystem>
#include <stdexcept>

#include <fmt/format.h>

#include <mesh/mesh_format.h>

namespace tetralux::mesh {
namespace {

// One line per format; the first that accepts a source reads it.
const std::array formats{
    &generatedFormat,
};

std::string knownSources() {
    std::string list;
    for (const MeshFormat* format : formats) {
        list += fmt::format("{}{}", list.empty() ? "" : ", ", format->sources);
    }
    return list;
}

[[noreturn]] void refuseUnknown(const std::string& source) {
    std::error_code ignored;
    if (std::filesystem::is_directory(source, ignored)) {
        throw std::runtime_error(fmt::format("{}: is a directory; give a mesh file", source));
    }
    if (!std::filesystem::exists(source, ignored)) {
        throw std::runtime_error(
            fmt::format("{}: no such file; give a mesh file or a generated field (bucky:32)", source));
    }
    throw std::runtime_error(fmt::format("{}: unknown mesh format; give one of {}", source, knownSources()));
}

}  // namespace

ReadResult readMesh(const std::string& source, const ReadOptions& options) {
    for (const MeshFormat* format : formats) {
        if (format->accepts(source)) {
            return format->read(source, options);
        }
    }
    refuseUnknown(source);
}

}  // namespace tetralux::mesh
