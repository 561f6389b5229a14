// SPDX-License-Identifier: Apache-2.0
#include <mesh/io/file_checks.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string_view>

#include <fmt/format.h>

namespace tetralux::mesh {

bool hasExtension(const std::string& source, std::span<const char* const> extensions) {
    const auto same = [](char a, char b) {
        return std::tolower(static_cast<unsigned char>(a)) == std::tolower(static_cast<unsigned char>(b));
    };
    return std::any_of(extensions.begin(), extensions.end(), [&](std::string_view extension) {
        return source.size() > extension.size() &&
               std::equal(extension.rbegin(), extension.rend(), source.rbegin(), same);
    });
}

void checkReadable(const std::string& source) {
    const auto refuse = [&](const char* why) { throw std::runtime_error(fmt::format("{}: {}", source, why)); };
    std::error_code failed;
    if (std::filesystem::is_directory(source, failed)) {
        refuse("is a directory; give a mesh file");
    }
    if (!std::filesystem::exists(source, failed)) {
        refuse("no such file; check the path, or give a generated field (bucky:32)");
    }
    if (!std::ifstream(source)) {
        refuse("may not be read; check its permissions");
    }
    if (std::filesystem::is_regular_file(source, failed) && std::filesystem::file_size(source, failed) == 0) {
        refuse("is empty; write the file again");
    }
}

void checkBeginning(const std::string& source, std::initializer_list<std::string_view> beginnings, const char* what) {
    checkReadable(source);
    std::string head(32, '\0');
    std::ifstream in(source, std::ios::binary);
    in.read(head.data(), static_cast<std::streamsize>(head.size()));
    head.resize(static_cast<std::size_t>(in.gcount()));
    if (std::none_of(beginnings.begin(), beginnings.end(), [&](std::string_view b) { return head.starts_with(b); })) {
        throw std::runtime_error(fmt::format(
            "{}: does not begin as {} does; check the name's ending or write the file again", source, what));
    }
}

}  // namespace tetralux::mesh
