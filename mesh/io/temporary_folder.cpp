// SPDX-License-Identifier: Apache-2.0
#include <mesh/io/temporary_folder.h>

#include <cstdlib>
#include <stdexcept>
#include <system_error>

#include <fmt/format.h>

namespace tetralux::mesh {

TemporaryFolder::TemporaryFolder(const std::string& source) {
    std::error_code failed;
    const std::filesystem::path where = std::filesystem::temp_directory_path(failed);
    std::string pattern = (where / "tetralux-XXXXXX").string();
    if (failed || ::mkdtemp(pattern.data()) == nullptr) {
        throw std::runtime_error(fmt::format("{}: temporary files cannot be made in {}; make room there or set TMPDIR",
                                             source, where.string()));
    }
    path_ = pattern;
}

TemporaryFolder::~TemporaryFolder() {
    std::error_code failed;
    std::filesystem::remove_all(path_, failed);
}

void TemporaryFolder::link(const std::filesystem::path& target, const std::filesystem::path& name) const {
    std::error_code failed;
    std::filesystem::create_symlink(std::filesystem::absolute(target, failed), path_ / name, failed);
}

std::string TemporaryFolder::shown(std::string message, const std::filesystem::path& instead) const {
    const std::string own = path_.string();
    for (std::size_t at = message.find(own); at != std::string::npos; at = message.find(own, at + 1)) {
        message.replace(at, own.size(), instead.string());
    }
    return message;
}

}  // namespace tetralux::mesh
