// SPDX-License-Identifier: Apache-2.0
#include <apps/bench_memory.h>

#include <malloc.h>

#include <fstream>
#include <string>

namespace tetralux::apps {

namespace {

/// A line "VmHWM:  1234 kB" of /proc/self/status, in bytes; 0 when there is none.
std::uint64_t statusBytes(const std::string& key) {
    std::ifstream status("/proc/self/status");
    for (std::string line; std::getline(status, line);)
        if (line.starts_with(key + ":")) return std::stoull(line.substr(key.size() + 1)) * 1024;
    return 0;
}

}  // namespace

std::uint64_t trimmedMemoryBytes() {
    malloc_trim(0);
    return statusBytes("VmRSS");
}

bool restartPeakMemory() {
    std::ofstream clear("/proc/self/clear_refs");  // 5 resets the high-water mark: proc(5)
    clear << 5 << std::flush;
    return clear.good();
}

std::uint64_t peakMemoryBytes() {
    return statusBytes("VmHWM");
}

}  // namespace tetralux::apps
