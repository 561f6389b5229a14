// SPDX-License-Identifier: Apache-2.0
#include <apps/mesh_command.h>

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <stdexcept>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

namespace tetralux::apps {
namespace {

constexpr const char* helper = "tetralux-mesher";

/// Replaces this process by the helper, so that signals, output and exit status are the helper's. Returns only by an
/// exception.
int becomeMesher(const std::vector<std::string>& arguments) {
    std::vector<std::string> words{helper};
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::vector<char*> pointers;
    for (std::string& word : words) pointers.push_back(word.data());
    pointers.push_back(nullptr);
    std::fflush(nullptr);
    for (const std::string& place : mesherPlaces()) {
        execv(place.c_str(), pointers.data());
        if (errno != ENOENT && errno != ENOTDIR)
            throw std::runtime_error(
                fmt::format("{} cannot be started ({}): install it anew", place, std::strerror(errno)));
    }
    throw std::runtime_error(
        fmt::format("the helper program {0} is missing: put it beside tetralux or into a folder of PATH "
                    "(it is built with TETRALUX_MESHER=ON)",
                    helper));
}

}  // namespace

std::vector<std::string> mesherPlaces() {
    std::vector<std::string> places;
    std::error_code failed;
    const std::filesystem::path self = std::filesystem::read_symlink("/proc/self/exe", failed);
    if (!failed) places.push_back((self.parent_path() / helper).string());
    const char* path = std::getenv("PATH");
    std::string folders = path == nullptr ? "" : path;
    for (std::size_t start = 0; start <= folders.size();) {
        const std::size_t end = std::min(folders.find(':', start), folders.size());
        if (end > start)
            places.push_back((std::filesystem::path(folders.substr(start, end - start)) / helper).string());
        start = end + 1;
    }
    return places;
}

void addMeshCommand(CLI::App& program, Command& chosen) {
    CLI::App* command = program.add_subcommand(
        "mesh", "points, surfaces or other cells to tetrahedra; 'tetralux mesh --help' says more");
    command->set_help_flag();   // the helper knows its own options
    command->prefix_command();  // all that follows is for it
    command->callback([command, &chosen] { chosen = [command] { return becomeMesher(command->remaining()); }; });
}

}  // namespace tetralux::apps
