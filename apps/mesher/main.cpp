// SPDX-License-Identifier: Apache-2.0
/// \file
/// tetralux-mesher: watches over the child process that does the work, so that whatever becomes of it is one sentence,
/// and no file but a whole one is left behind. `tetralux mesh` starts it.
#include <fmt/format.h>
#include <signal.h>
#include <stdlib.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>

#include "child_process.h"
#include "options.h"
#include "pipeline.h"

namespace tetralux::mesher {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr int badInput = 2;

double seconds(Clock::duration d) {
    return std::chrono::duration<double>(d).count();
}

/// A folder beside the output for what is not whole yet; gone when this is.
class Workshop {
public:
    explicit Workshop(const std::string& output) {
        const fs::path folder = fs::absolute(output).parent_path();
        path_ = (folder / ".tetralux-mesh-XXXXXX").string();
        if (mkdtemp(path_.data()) == nullptr)
            throw std::runtime_error(fmt::format(
                "{}: cannot be written: make the folder {} and see that you may write there", output, folder.string()));
    }
    ~Workshop() {
        std::error_code ignored;
        fs::remove_all(path_, ignored);
    }
    Workshop(const Workshop&) = delete;
    Workshop& operator=(const Workshop&) = delete;
    std::string file() const { return path_ + "/mesh.vtu"; }

private:
    std::string path_;
};

/// One line on the terminal that says what is going on and for how long; none if standard error is not a terminal.
class ProgressLine {
public:
    explicit ProgressLine(bool quiet) : shown_(!quiet && isatty(STDERR_FILENO) != 0) {}
    ~ProgressLine() { clear(); }
    ProgressLine(const ProgressLine&) = delete;
    ProgressLine& operator=(const ProgressLine&) = delete;
    void stage(std::string_view name) {
        if (!name.empty()) {
            name_ = name;
            since_ = Clock::now();
        }
        if (!shown_ || name_.empty()) return;
        fmt::print(stderr, "\r\x1b[K{}, {:.0f} s", name_, seconds(Clock::now() - since_));
        std::fflush(stderr);
    }
    void clear() const {
        if (shown_) fmt::print(stderr, "\r\x1b[K");
    }
    const std::string& name() const { return name_; }

private:
    bool shown_;
    std::string name_;
    Clock::time_point since_ = Clock::now();
};

/// Nine tenths of the machine's memory: a broken file's demands must not push all else out. (Sanitizers reserve far
/// more.)
std::uint64_t memoryLimit() {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    return 0;
#else
    return static_cast<std::uint64_t>(sysconf(_SC_PHYS_PAGES)) / 10 * 9 *
           static_cast<std::uint64_t>(sysconf(_SC_PAGE_SIZE));
#endif
}

std::string problemOf(const ChildOutcome& outcome, const Options& options, const std::string& stage) {
    using End = ChildOutcome::End;
    switch (outcome.end) {
        case End::Error:
            return outcome.error;
        case End::TimedOut:
            return fmt::format(
                "{}: {} took longer than the time limit of {} s: take coarser bounds or a longer --time-limit",
                options.input, stage, options.timeLimit);
        case End::Interrupted:
            return fmt::format("{}: interrupted while {}; nothing was written", options.input, stage);
        case End::Signal:
            return fmt::format("{}: a library crashed ({}) while {}: is the file whole?", options.input,
                               strsignal(outcome.code), stage);
        default:
            return fmt::format("{}: a library gave up (exit {}) while {}: is the file whole?", options.input,
                               outcome.code, stage);
    }
}

void writeReport(const std::string& path, const std::string& text) {
    if (path.empty()) return;
    const std::string beside = path + ".part";
    std::ofstream file(beside);
    file << nlohmann::json::parse(text).dump(2) << '\n';
    file.close();
    std::error_code failed;
    if (file) fs::rename(beside, path, failed);
    if (!file || failed) {
        fs::remove(beside, failed);
        throw std::runtime_error(fmt::format("{}: the report cannot be written there", path));
    }
}

int run(const Options& options) {
    const auto start = Clock::now();
    const Workshop workshop(options.output);
    ProgressLine progress(options.quiet);
    ChildLimits limits;
    const double longest = 1e8;  // seconds, so that the clock does not overflow
    limits.deadline = start + std::chrono::duration_cast<Clock::duration>(
                                  std::chrono::duration<double>(std::min(options.timeLimit, longest)));
    limits.memoryBytes = memoryLimit();
    limits.ownProcessGroup = true;
    const auto work = [&](const MessagePipe& pipe) {
        const Listener listener{[&](const std::string& text) { pipe.send(MessageKind::Stage, text); },
                                [&](const std::string& text) { pipe.send(MessageKind::Note, text); }};
        const nlohmann::json report = makeMesh(options, workshop.file(), limits.deadline, listener);
        pipe.send(MessageKind::Result, report.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
    };
    const auto onMessage = [&](MessageKind kind, std::string_view text) {
        if (kind == MessageKind::Stage) progress.stage(text);
        if (kind != MessageKind::Note || options.quiet) return;
        progress.clear();
        fmt::print("{}\n", text);
        std::fflush(stdout);
    };
    const ChildOutcome outcome = runInChild(limits, work, onMessage);
    progress.clear();
    if (outcome.end != ChildOutcome::End::Finished) {
        fmt::print(stderr, "tetralux: {}\n",
                   problemOf(outcome, options, progress.name().empty() ? "starting" : progress.name()));
        return badInput;
    }
    writeReport(options.report, outcome.result);
    std::error_code failed;
    fs::rename(workshop.file(), options.output, failed);
    if (failed) throw std::runtime_error(fmt::format("{}: cannot be written ({})", options.output, failed.message()));
    if (!options.quiet) fmt::print("wrote {} in {:.2f} s\n", options.output, seconds(Clock::now() - start));
    return 0;
}

}  // namespace
}  // namespace tetralux::mesher

int main(int argumentCount, char** arguments) {
    try {
        const auto options = tetralux::mesher::parseCommandLine(argumentCount, arguments);
        return options ? tetralux::mesher::run(*options) : 0;
    } catch (const std::exception& error) {
        std::string line = error.what();
        for (char& c : line)
            if (c == '\n' || c == '\r') c = ' ';
        fmt::print(stderr, "tetralux: {}\n", line);
        return tetralux::mesher::badInput;
    }
}
