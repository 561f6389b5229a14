// SPDX-License-Identifier: Apache-2.0
#include <projection/image/whole_file.h>

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <stdexcept>
#include <system_error>

#include <fmt/format.h>

namespace tetralux::projection {

namespace {

namespace fs = std::filesystem;

std::string reasonOf(int error) {
    return std::generic_category().message(error);
}

/// The file that a path stands for, symbolic links followed.
fs::path resolvedTarget(const std::string& path) {
    std::error_code ignored;
    const fs::path canonical = fs::weakly_canonical(path, ignored);
    return ignored ? fs::path(path) : canonical;
}

void checkTarget(const std::string& path, const fs::path& target) {
    std::error_code error;
    const fs::path folder = target.has_parent_path() ? target.parent_path() : fs::path(".");
    if (!fs::is_directory(folder, error))
        throw std::runtime_error(fmt::format(
            "{}: the folder '{}' does not exist; make it first or choose another output", path, folder.string()));
    if (fs::is_directory(target, error))
        throw std::runtime_error(fmt::format("{}: is a folder; give the name of a file in it", path));
    if (fs::exists(target, error) && !fs::is_regular_file(target, error))
        throw std::runtime_error(fmt::format("{}: is not a regular file; choose another output", path));
}

/// The unfinished file beside the target. It is removed unless `finish` gave it its name.
class FileBeside {
public:
    FileBeside(const std::string& path, const fs::path& target) : path_(path), target_(target) {
        beside_ = target.parent_path() / fmt::format(".{}.{}.part", target.filename().string(), ::getpid());
        descriptor_ = ::open(beside_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
        if (descriptor_ < 0) fail(errno, "choose a folder that you may write to");
    }
    FileBeside(const FileBeside&) = delete;
    FileBeside& operator=(const FileBeside&) = delete;
    ~FileBeside() {
        if (descriptor_ >= 0) ::close(descriptor_);
        if (!finished_) ::unlink(beside_.c_str());
    }

    void write(std::string_view bytes) {
        while (!bytes.empty()) {
            const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
            if (written < 0 && errno == EINTR) continue;
            if (written <= 0) fail(errno, "free some space or choose another output");
            bytes.remove_prefix(static_cast<std::size_t>(written));
        }
    }

    void finish() {
        const int descriptor = descriptor_;
        descriptor_ = -1;
        if (::close(descriptor) != 0) fail(errno, "free some space or choose another output");
        if (::rename(beside_.c_str(), target_.c_str()) != 0) fail(errno, "choose another output");
        finished_ = true;
    }

private:
    [[noreturn]] void fail(int error, const char* remedy) const {
        throw std::runtime_error(fmt::format("{}: cannot be written ({}); {}", path_, reasonOf(error), remedy));
    }

    std::string path_;
    fs::path target_, beside_;
    int descriptor_ = -1;
    bool finished_ = false;
};

}  // namespace

void writeWholeFile(const std::string& path, std::string_view bytes) {
    const fs::path target = resolvedTarget(path);
    checkTarget(path, target);
    FileBeside file(path, target);
    file.write(bytes);
    file.finish();
}

void checkWritable(const std::string& path) {
    const fs::path target = resolvedTarget(path);
    checkTarget(path, target);
    const FileBeside tried(path, target);
}

}  // namespace tetralux::projection
