// SPDX-License-Identifier: Apache-2.0
/// \file
/// Bare voxel values, x fastest, little-endian. Size and type come from the name as volume collections write it
/// (`bonsai_256x256x256_uint8.raw`) or are put behind it (`data.raw:256x256x256:uint8`); without a type the size of
/// the file says how many bytes a value has.
#include <array>
#include <filesystem>
#include <optional>
#include <regex>
#include <stdexcept>

#include <fmt/format.h>

#include <mesh/io/file_checks.h>
#include <mesh/io/mesh_format.h>
#include <mesh/io/text_scanner.h>
#include <mesh/io/voxel_types.h>
#include <mesh/soup/grid_soup.h>

namespace tetralux::mesh {
namespace {

struct RawSource {
    std::string path;
    std::array<std::size_t, 3> size{};
    std::string type;
};

/// What `source` says of its size, if it is a raw file at all; size 0 when it says nothing.
std::optional<RawSource> parseRawSource(const std::string& source) {
    static const std::regex behind(R"((.*\.raw):(\d{1,6})x(\d{1,6})x(\d{1,6})(?::([a-z]+\d*))?)", std::regex::icase);
    static const std::regex within(R"(.*[_.-](\d{1,6})x(\d{1,6})x(\d{1,6})(?:[_.-]([a-z]+\d*))?\.raw)",
                                   std::regex::icase);
    std::smatch found;
    RawSource raw;
    std::size_t group = 2;
    if (std::regex_match(source, found, behind)) {
        raw.path = found[1];
    } else if (!hasExtension(source, {".raw"})) {
        return std::nullopt;
    } else {
        raw.path = source;
        const std::string name = std::filesystem::path(source).filename().string();
        if (name.size() > 255) {
            return raw;  // std::regex would recurse too deeply
        }
        std::smatch inName;
        if (!std::regex_match(name, inName, within)) {
            return raw;
        }
        for (std::size_t axis = 0; axis < 3; ++axis) {
            raw.size[axis] = std::stoul(inName[axis + 1]);
        }
        raw.type = inName[4];
        return raw;
    }
    for (std::size_t axis = 0; axis < 3; ++axis) {
        raw.size[axis] = std::stoul(found[group + axis]);
    }
    raw.type = found[5];
    return raw;
}

const VoxelType& findType(const RawSource& raw, std::size_t bytes) {
    const std::size_t values = raw.size[0] * raw.size[1] * raw.size[2];
    for (const VoxelType& type : voxelTypes()) {
        if (raw.type.empty() ? type.size * values == bytes : type.isCalled(raw.type)) {
            if (type.size * values == bytes) {
                return type;
            }
            throw std::runtime_error(fmt::format(
                "{}: has {} bytes where {}x{}x{} values of {} bytes are {}; give its size and type as in "
                "{}:64x64x64:uint8",
                raw.path, bytes, raw.size[0], raw.size[1], raw.size[2], type.size, type.size * values, raw.path));
        }
    }
    throw std::runtime_error(
        fmt::format("{}: has {} bytes, which fits no type of {} values; give its size and type as in {}:64x64x64:uint8",
                    raw.path, bytes, values, raw.path));
}

bool acceptsRaw(const std::string& source) {
    return source.size() < 4096 && parseRawSource(source).has_value();
}

CellSoup readRaw(const std::string& source, const ReadOptions&) {
    const RawSource raw = *parseRawSource(source);
    checkReadable(raw.path);
    if (raw.size[0] == 0) {
        throw std::runtime_error(fmt::format(
            "{}: bare values need a size; put it behind the name as in {}:64x64x64:uint8", raw.path, raw.path));
    }
    const std::string bytes = readWholeFile(raw.path);
    const VoxelType& type = findType(raw, bytes.size());
    CellSoup soup = gridSoup(raw.size, raw.path);
    Field field;
    field.name = "value";
    field.values.resize(soup.points.size());
    for (std::size_t i = 0; i < field.values.size(); ++i) {
        field.values[i] = type.at(bytes.data() + i * type.size, false);
    }
    soup.fields.push_back(std::move(field));
    return soup;
}

}  // namespace

const MeshFormat rawFormat{"raw voxels", ".raw with size, as in head.raw:64x64x64:uint8", acceptsRaw, readRaw};

}  // namespace tetralux::mesh
