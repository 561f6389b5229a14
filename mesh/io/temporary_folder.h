// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

namespace tetralux::mesh {

/// A folder that goes with this object, for readers that need files in other places or under other names than they are.
class TemporaryFolder {
public:
    /// \throws std::runtime_error naming `source`, for which it is made, if there is no room.
    explicit TemporaryFolder(const std::string& source);
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;
    ~TemporaryFolder();
    const std::filesystem::path& path() const { return path_; }
    /// A link to `target` called `name`, unless something is called so already.
    void link(const std::filesystem::path& target, const std::filesystem::path& name) const;
    /// `message` with `instead` wherever it names this folder, which no one knows.
    std::string shown(std::string message, const std::filesystem::path& instead) const;

private:
    std::filesystem::path path_;
};

}  // namespace tetralux::mesh
