// SPDX-License-Identifier: Apache-2.0
#include <mesh/io/isolated_read.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <mutex>
#include <new>
#include <stdexcept>

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <mesh/io/file_checks.h>
#include <mesh/io/soup_transfer.h>
#include <mesh/io/vtk_soup.h>

namespace tetralux::mesh {
namespace {

/// A file descriptor that closes itself.
class Descriptor {
public:
    explicit Descriptor(int file) : file_(file) {}
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    ~Descriptor() { close(); }
    int get() const { return file_; }
    void close() {
        if (file_ >= 0) {
            ::close(file_);
        }
        file_ = -1;
    }

private:
    int file_;
};

/// Numbers that no library exits with: some call exit(0) or exit(1) on bad input.
enum ExitStatus : int { resultWritten = 101, errorWritten = 102, outOfMemory = 103, notWritten = 104 };

/// Memory limits do not go with the address space that a sanitizer reserves.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool canLimitMemory = false;
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer) || __has_feature(memory_sanitizer)
constexpr bool canLimitMemory = false;
#else
constexpr bool canLimitMemory = true;
#endif
#else
constexpr bool canLimitMemory = true;
#endif

/// Whether the data may stand in other files, of any size.
bool mayNameOthers(const std::string& source) {
    return hasExtension(source, {".pvtu", ".pvti", ".pvtr", ".pvts", ".pvtp", ".vtm", ".vtpd", ".vtpc", ".vth", ".vthb",
                                 ".pvd", ".case", ".encas", ".foam", ".mhd", ".cgns", ".cas"});
}

/// What a reader may need of memory, in bytes: no compression here shrinks data to less than a few thousandths, a byte
/// may become a double, and cells are made of it. Nothing is known of files that only name those with the data.
std::uint64_t memoryFor(const std::string& source) {
    constexpr std::uint64_t base = std::uint64_t{512} << 20, perByte = 65536;
    const std::uint64_t machine = static_cast<std::uint64_t>(sysconf(_SC_PHYS_PAGES)) *
                                  static_cast<std::uint64_t>(sysconf(_SC_PAGE_SIZE)) / 4 * 3;
    std::error_code failed;
    const std::uint64_t size = std::filesystem::file_size(source, failed);
    return failed || mayNameOthers(source) || size > machine / perByte ? machine
                                                                       : std::min(machine, base + perByte * size);
}

/// Bytes that this process may write to, which a forked one has too.
std::uint64_t memoryInUse() {
    std::uint64_t pages[6] = {};  // size, resident, shared, text, library, data
    std::ifstream status("/proc/self/statm");
    for (std::uint64_t& count : pages) {
        status >> count;
    }
    return pages[5] * static_cast<std::uint64_t>(sysconf(_SC_PAGE_SIZE));
}

/// Of processor time: what is read quickly may wait long on a busy machine.
std::chrono::seconds timeLimit(const std::string& source) {
    std::error_code failed;
    const auto size = std::filesystem::file_size(source, failed);
    const long long base = failed || mayNameOthers(source) ? 60 : 10;
    return std::chrono::seconds(base + (failed ? 0 : static_cast<long long>(size >> 20)));
}

void limitChild(const std::string& source) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    const rlimit noCore{0, 0};
    setrlimit(RLIMIT_CORE, &noCore);
    const rlim_t limit = memoryInUse() + memoryFor(source);
    const rlimit memory{limit, limit};
    if (canLimitMemory) {
        setrlimit(RLIMIT_DATA, &memory);
    }
    const auto seconds = static_cast<rlim_t>(timeLimit(source).count());
    const rlimit time{seconds, seconds + 1};
    setrlimit(RLIMIT_CPU, &time);
    for (const int fault : {SIGSEGV, SIGBUS, SIGABRT, SIGFPE, SIGILL, SIGTERM, SIGINT}) {
        std::signal(fault, SIG_DFL);
    }
    const int nowhere = ::open("/dev/null", O_RDWR);
    if (nowhere >= 0) {
        for (const int stream : {0, 1, 2}) {
            ::dup2(nowhere, stream);
        }
    }
}

/// What the child does: never returns, and leaves without destructors or exit handlers, which belong to the parent.
[[noreturn]] void runChild(const std::string& source, int output, const std::function<CellSoup()>& read) {
    limitChild(source);
    ExitStatus status = notWritten;
    try {
        const CellSoup soup = read();
        status = writeSoup(output, soup) ? resultWritten : notWritten;
    } catch (const std::bad_alloc&) {
        status = outOfMemory;
    } catch (const std::exception& error) {
        const std::size_t length = std::strlen(error.what());
        status = ::write(output, error.what(), length) == static_cast<ssize_t>(length) ? errorWritten : notWritten;
    } catch (...) {
        status = notWritten;
    }
    _exit(status);
}

/// Waits until `pipe`'s last writer, the child, is gone. \returns false after `limit`.
bool waitForEnd(int pipe, std::chrono::seconds limit) {
    const auto deadline = std::chrono::steady_clock::now() + limit;
    for (;;) {
        const auto left =
            std::chrono::duration_cast<std::chrono::milliseconds>(deadline - std::chrono::steady_clock::now());
        if (left.count() <= 0) {
            return false;
        }
        pollfd watched{pipe, POLLIN, 0};
        const int ready = ::poll(&watched, 1, static_cast<int>(std::min<long long>(left.count(), 1'000'000)));
        if (ready > 0 || (ready < 0 && errno != EINTR)) {
            return true;
        }
    }
}

int reap(pid_t child) {
    int status = 0;
    while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    return status;
}

std::string readText(int file) {
    std::string text(static_cast<std::size_t>(::lseek(file, 0, SEEK_END)), '\0');
    const ssize_t got = ::pread(file, text.data(), text.size(), 0);
    text.resize(got < 0 ? 0 : static_cast<std::size_t>(got));
    return text;
}

[[noreturn]] void refuse(const std::string& source, const std::string& why) {
    throw std::runtime_error(fmt::format("{}: {}", source, why));
}

/// In this process. Neither VTK's messages nor the libraries below its readers are made for threads.
CellSoup readHere(const std::string& source, const std::function<CellSoup()>& read) {
    static std::recursive_mutex one;  // a list of files reads them while it is read
    const std::lock_guard lock(one);
    const SilentVtk silent;
    try {
        return read();
    } catch (const std::bad_alloc&) {
        refuse(source, "asks for more memory than there is; if it is not damaged, take a larger machine");
    } catch (const std::exception& error) {
        refuse(source, error.what());
    }
}

CellSoup readIsolated(const std::string& source, const std::function<CellSoup()>& read) {
    const Descriptor result(::memfd_create("tetralux-mesh", MFD_CLOEXEC));
    int ends[2] = {-1, -1};
    if (result.get() < 0 || ::pipe2(ends, O_CLOEXEC) != 0) {
        refuse(source, "no file descriptor left to read it with; close files");
    }
    const Descriptor watch(ends[0]);
    Descriptor alive(ends[1]);
    const pid_t child = ::fork();
    if (child < 0) {
        refuse(source, "no process can be started to read it; end others");
    }
    if (child == 0) {
        runChild(source, result.get(), read);
    }
    alive.close();
    constexpr int mostWaiting = 10;  // times as long as it computes
    const bool ended = waitForEnd(watch.get(), mostWaiting * timeLimit(source));
    if (!ended) {
        ::kill(child, SIGKILL);
    }
    const int status = reap(child);
    if (!ended || (WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU)) {
        refuse(source, "reading takes too long; if other programs read it, save it as .vtu there");
    }
    const int outcome = WIFEXITED(status) ? WEXITSTATUS(status) : notWritten;
    if (outcome == outOfMemory) {
        refuse(source,
               "asks for more memory than a file of its size can need, or than this machine has; if it is not "
               "damaged, take a larger machine");
    }
    if (outcome == errorWritten) {
        refuse(source, readText(result.get()));
    }
    if (outcome != resultWritten) {
        refuse(source,
               "its reader does not survive it; if other programs read it, save it as .vtu there, else write it again");
    }
    CellSoup soup;
    ::lseek(result.get(), 0, SEEK_SET);
    if (!readSoup(result.get(), soup)) {
        refuse(source, "its reader did not finish; there may be too little memory");
    }
    return soup;
}

}  // namespace

CellSoup readThirdParty(const std::string& source, bool isolated, const std::function<CellSoup()>& read) {
    return isolated ? readIsolated(source, read) : readHere(source, read);
}

}  // namespace tetralux::mesh
