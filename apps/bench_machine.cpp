// SPDX-License-Identifier: Apache-2.0
#include <apps/bench_machine.h>

#include <sys/utsname.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <fstream>
#include <string>
#include <thread>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace tetralux::apps {

namespace {

/// What follows `key` and `separator` in the first line of `path` that starts with key; quotes and blanks around it are
/// taken off.
std::string valueInFile(const std::string& path, const std::string& key, char separator) {
    std::ifstream file(path);
    for (std::string line; std::getline(file, line);) {
        const std::size_t at = line.find(separator);
        if (!line.starts_with(key) || at == std::string::npos) continue;
        const std::size_t from = line.find_first_not_of(" \t\"", at + 1);
        const std::size_t to = line.find_last_not_of(" \t\"");
        return from == std::string::npos ? "" : line.substr(from, to - from + 1);
    }
    return "";
}

std::string compiler() {
#if defined(__clang__)
    return "clang " __clang_version__;
#else
    return "g++ " __VERSION__;
#endif
}

}  // namespace

nlohmann::json machineDescription() {
    utsname system{};
    uname(&system);
    std::array<double, 3> load{};
    getloadavg(load.data(), 3);
    return {{"cpu", valueInFile("/proc/cpuinfo", "model name", ':')},
            {"cores", std::thread::hardware_concurrency()},
            {"memory_bytes",
             static_cast<std::uint64_t>(sysconf(_SC_PHYS_PAGES)) * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE))},
            {"os", valueInFile("/etc/os-release", "PRETTY_NAME", '=')},
            {"kernel", fmt::format("{} {} {}", system.sysname, system.release, system.machine)},
            {"compiler", compiler()},
            {"tetralux", TETRALUX_VERSION},
            {"load", load}};
}

}  // namespace tetralux::apps
