// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <memory>
#include <stdexcept>
#include <string>

#include <fmt/format.h>
#include <libdeflate.h>

#include <mesh/io/file_checks.h>
#include <mesh/io/mesh_format.h>
#include <mesh/io/temporary_folder.h>
#include <mesh/io/text_scanner.h>

namespace tetralux::mesh {
namespace {

namespace fs = std::filesystem;

constexpr const char* ending = ".gz";

std::string withoutEnding(const std::string& name) {
    return name.substr(0, name.size() - std::char_traits<char>::length(ending));
}

bool acceptsGzip(const std::string& source) {
    return hasExtension(source, {ending}) && formatOf(withoutEnding(source)) != nullptr;
}

/// All members of a file that gzip wrote. \throws std::runtime_error naming it.
std::string unpacked(const std::string& source) {
    checkBeginning(source, {"\x1f\x8b"}, "a file of gzip");
    const std::string packed = readWholeFile(source);
    const std::unique_ptr<libdeflate_decompressor, void (*)(libdeflate_decompressor*)> inflater(
        libdeflate_alloc_decompressor(), &libdeflate_free_decompressor);
    constexpr std::size_t mostPerByte = 1032;  // of what deflate can say
    std::string text;
    std::size_t room = 4 * packed.size() + 4096;
    for (std::size_t from = 0, to = 0; from < packed.size();) {
        text.resize(to + room);
        std::size_t taken = 0, given = 0;
        const libdeflate_result result =
            inflater == nullptr
                ? LIBDEFLATE_BAD_DATA
                : libdeflate_gzip_decompress_ex(inflater.get(), packed.data() + from, packed.size() - from,
                                                text.data() + to, room, &taken, &given);
        if (result == LIBDEFLATE_INSUFFICIENT_SPACE && room <= mostPerByte * packed.size()) {
            room *= 2;
            continue;
        }
        if (result != LIBDEFLATE_SUCCESS)
            throw std::runtime_error(fmt::format("{}: cannot be unpacked: damaged or cut off; write it again", source));
        from += taken;
        to += given;
        text.resize(to);
    }
    return text;
}

void unpackTo(const fs::path& source, const TemporaryFolder& folder) {
    const std::string text = unpacked(source.string());
    std::ofstream file(folder.path() / withoutEnding(source.filename().string()), std::ios::binary);
    if (!file.write(text.data(), static_cast<std::streamsize>(text.size())).flush())
        throw std::runtime_error(fmt::format("{}: no room for it unpacked in {}; make some or set TMPDIR",
                                             source.string(), folder.path().parent_path().string()));
}

/// What formats of several files have beside the first, packed like it: a.cas.gz, a.dat.gz.
constexpr std::initializer_list<const char*> companions{".dat.gz", ".ele.gz", ".node.gz", ".sol.gz", ".raw.gz"};

/// Formats of several files find the others beside the first.
void addCompanions(const fs::path& source, const TemporaryFolder& folder) {
    const std::string stem = fs::path(withoutEnding(source.filename().string())).stem().string() + ".";
    std::error_code failed;
    const fs::path beside = fs::absolute(source, failed).parent_path();
    for (const fs::directory_entry& entry : fs::directory_iterator(beside, failed)) {
        const std::string name = entry.path().filename().string();
        if (name == source.filename()) continue;
        if (hasExtension(name, companions) && name.starts_with(stem))
            unpackTo(entry.path(), folder);
        else
            folder.link(entry.path(), name);
    }
}

CellSoup readGzip(const std::string& source, const ReadOptions& options) {
    checkReadable(source);
    const TemporaryFolder folder(source);
    unpackTo(source, folder);
    addCompanions(source, folder);
    const std::string inner = (folder.path() / withoutEnding(fs::path(source).filename().string())).string();
    try {
        return formatOf(inner)->read(inner, options);
    } catch (const std::runtime_error& error) {
        const fs::path parent = fs::path(source).parent_path();
        throw std::runtime_error(folder.shown(error.what(), parent.empty() ? "." : parent));
    }
}

}  // namespace

const MeshFormat gzipFormat{"gzip", "any of these with .gz", acceptsGzip, readGzip};

}  // namespace tetralux::mesh
