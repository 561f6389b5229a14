// SPDX-License-Identifier: Apache-2.0
//
// Feeds the formats that we parse ourselves. The first byte chooses one; a refusal is a std::runtime_error, anything
// else is a fault.
#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <string_view>

#include <fmt/format.h>
#include <unistd.h>

#include <mesh/io/appended_vtu.h>
#include <mesh/io/parse_mesh.h>
#include <mesh/soup/validation.h>

namespace {

using namespace tetralux::mesh;

/// Two texts in one input, parted by a zero byte.
CellSoup parseTwo(std::string_view bytes) {
    const std::size_t zero = std::min(bytes.find('\0'), bytes.size());
    const std::string_view second = zero < bytes.size() ? bytes.substr(zero + 1) : std::string_view();
    return parseTetgen(bytes.substr(0, zero), "f.node", second, "f.ele");
}

CellSoup parseWithSolution(std::string_view bytes) {
    const std::size_t zero = std::min(bytes.find('\0'), bytes.size());
    CellSoup soup = parseMeditText(bytes.substr(0, zero), "f.mesh");
    if (zero < bytes.size()) {
        parseMeditSolution(bytes.substr(zero + 1), "f.sol", soup);
    }
    return soup;
}

CellSoup readAppended(std::string_view bytes) {
    static const std::string path =
        (std::filesystem::temp_directory_path() / fmt::format("tetralux-fuzz-{}.vtu", ::getpid())).string();
    std::ofstream(path, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    return readAppendedVtu(path).value_or(CellSoup{});
}

CellSoup parse(std::uint8_t kind, std::string_view bytes) {
    switch (kind % 6) {
        case 0:
            return parseGmsh(bytes, "f.msh", 0.5);
        case 1:
            return parseWithSolution(bytes);
        case 2:
            return parseMeditBinary(bytes, "f.meshb");
        case 3:
            return parseTwo(bytes);
        case 4:
            return readAppended(bytes);
        default:
            return parseNrrd(bytes, "f.nrrd", [](const std::string&) { return std::string(64, '1'); });
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size == 0) {
        return 0;
    }
    try {
        tetMeshFromSoup(parse(data[0], {reinterpret_cast<const char*>(data) + 1, size - 1}));
    } catch (const std::runtime_error&) {
    }
    return 0;
}
