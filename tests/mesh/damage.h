// SPDX-License-Identifier: Apache-2.0
/// \file
/// Damaged copies of files, and what reading one comes to.
#pragma once

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <stdexcept>
#include <string>

#include <fmt/format.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <mesh/io/read_mesh.h>
#include <mesh/tet/mesh_statistics.h>

namespace tetralux::mesh::test {

enum class Damage { RandomBytes, Truncated, BitsFlipped };
inline constexpr std::array damages{Damage::RandomBytes, Damage::Truncated, Damage::BitsFlipped};

inline const char* damageName(Damage damage) {
    return damage == Damage::RandomBytes ? "random bytes" : damage == Damage::Truncated ? "truncated" : "bits flipped";
}

/// A copy of `whole` with the damage that `seed` stands for: as many random bytes as `whole` has, at most 64 KiB; its
/// first bytes; or itself with 1, 2, 4, 8 or 16 bits turned over.
inline std::string damagedCopy(const std::string& whole, Damage damage, std::uint64_t seed) {
    std::mt19937_64 random(seed);
    const auto below = [&](std::size_t count) {
        return static_cast<std::size_t>(random() % std::max<std::size_t>(1, count));
    };
    if (damage == Damage::Truncated) {
        return whole.substr(0, below(whole.size()));
    }
    if (damage == Damage::RandomBytes) {
        std::string noise(below(std::min<std::size_t>(whole.size(), 65536)) + 1, '\0');
        std::generate(noise.begin(), noise.end(), [&] { return static_cast<char>(random()); });
        return noise;
    }
    std::string copy = whole;
    for (std::size_t flips = std::size_t{1} << below(5); flips > 0 && !copy.empty(); --flips) {
        copy[below(copy.size())] ^= static_cast<char>(1u << below(8));
    }
    return copy;
}

enum class ReadingEnd { Mesh, Refusal, Crash, Hang };

/// Takes `source` through reading, statistics and the choice of a scalar.
inline ReadingEnd readAll(const std::string& source) {
    try {
        ReadResult result = readMesh(source, isolatedReading());
        meshStatistics(result.mesh);
        selectScalar(std::move(result.mesh), "", result.report);
        return ReadingEnd::Mesh;
    } catch (const std::runtime_error& error) {
        const std::string text = error.what();
        return text.find('\n') == std::string::npos && !text.empty() ? ReadingEnd::Refusal : ReadingEnd::Crash;
    } catch (...) {
        return ReadingEnd::Crash;
    }
}

/// `readAll` in a child process, which is ended after `limit`. Call it from a process that has no threads.
inline ReadingEnd readInChild(const std::string& source, std::chrono::seconds limit) {
    int ends[2];
    if (::pipe(ends) != 0) {
        throw std::runtime_error("no file descriptor left");
    }
    const pid_t child = ::fork();
    if (child == 0) {
        ::close(ends[0]);
        ::_exit(static_cast<int>(readAll(source)));
    }
    ::close(ends[1]);
    pollfd watched{ends[0], POLLIN, 0};
    const bool ended = ::poll(&watched, 1, static_cast<int>(limit.count() * 1000)) != 0;
    ::close(ends[0]);
    if (!ended) {
        ::kill(child, SIGKILL);
    }
    int status = 0;
    while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    if (!ended) {
        return ReadingEnd::Hang;
    }
    return WIFEXITED(status) && WEXITSTATUS(status) <= static_cast<int>(ReadingEnd::Hang)
               ? static_cast<ReadingEnd>(WEXITSTATUS(status))
               : ReadingEnd::Crash;
}

inline std::string wholeFile(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

inline void writeFile(const std::filesystem::path& path, const std::string& bytes) {
    std::filesystem::remove(path);  // it may be a link to the whole one
    std::ofstream(path, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

}  // namespace tetralux::mesh::test
