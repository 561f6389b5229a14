// SPDX-License-Identifier: Apache-2.0
#include "child_process.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <new>
#include <utility>

namespace tetralux::mesher {
namespace {

constexpr std::size_t keptOutput = 4096;  // bytes of the child's prints
constexpr int tickMilliseconds = 200;

volatile sig_atomic_t caughtSignal = 0;
void onSignal(int number) {
    caughtSignal = number;
}

/// Catches the signals that end programs for as long as it lives.
class SignalGuard {
public:
    SignalGuard() {
        caughtSignal = 0;
        struct sigaction action {};
        action.sa_handler = onSignal;
        sigemptyset(&action.sa_mask);
        for (std::size_t i = 0; i < signals.size(); ++i) sigaction(signals[i], &action, &before_[i]);
    }
    ~SignalGuard() { restore(); }
    SignalGuard(const SignalGuard&) = delete;
    SignalGuard& operator=(const SignalGuard&) = delete;
    void restore() {
        for (std::size_t i = 0; i < signals.size(); ++i) sigaction(signals[i], &before_[i], nullptr);
    }

private:
    static constexpr std::array<int, 3> signals{SIGINT, SIGTERM, SIGHUP};
    std::array<struct sigaction, 3> before_{};
};

struct Pipe {
    int readEnd = -1, writeEnd = -1;
    Pipe() {
        int ends[2];
        if (pipe2(ends, O_CLOEXEC) != 0) throw std::runtime_error("no pipe can be made: too many open files");
        readEnd = ends[0];
        writeEnd = ends[1];
    }
    ~Pipe() {
        closeRead();
        closeWrite();
    }
    Pipe(const Pipe&) = delete;
    Pipe& operator=(const Pipe&) = delete;
    void closeRead() {
        if (readEnd >= 0) ::close(std::exchange(readEnd, -1));
    }
    void closeWrite() {
        if (writeEnd >= 0) ::close(std::exchange(writeEnd, -1));
    }
};

std::string oneLine(std::string text) {
    for (char& c : text)
        if (c == '\n' || c == '\r' || c == '\t') c = ' ';
    while (!text.empty() && text.back() == ' ') text.pop_back();
    return text;
}

[[noreturn]] void childMain(const ChildLimits& limits, pid_t parent, Pipe& messages, Pipe& prints,
                            const std::function<void(const MessagePipe&)>& work) {
    if (limits.ownProcessGroup) setpgid(0, 0);
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() != parent) _exit(1);  // it died before the line above
    signal(SIGPIPE, SIG_IGN);
    const rlimit noCore{0, 0};
    setrlimit(RLIMIT_CORE, &noCore);
    if (limits.memoryBytes > 0) {
        const rlimit memory{limits.memoryBytes, limits.memoryBytes};
        setrlimit(RLIMIT_AS, &memory);
    }
    dup2(prints.writeEnd, STDOUT_FILENO);
    dup2(prints.writeEnd, STDERR_FILENO);
    setvbuf(stdout, nullptr, _IONBF, 0);  // what a library says before it crashes must not be lost
    const MessagePipe pipe(messages.writeEnd);
    try {
        work(pipe);
    } catch (const std::bad_alloc&) {
        pipe.send(MessageKind::Error,
                  "more memory is needed than there is: is the file whole? Else take a coarser input");
    } catch (const std::length_error&) {
        pipe.send(MessageKind::Error,
                  "more memory is needed than there is: is the file whole? Else take a coarser input");
    } catch (const std::exception& error) {
        pipe.send(MessageKind::Error, oneLine(error.what()));
    }
    _exit(0);  // no exit handlers: they belong to the parent
}

/// Cuts whole messages (kind, 8 bytes of length, text) off the front of `buffer`.
void dispatch(std::string& buffer, ChildOutcome& outcome,
              const std::function<void(MessageKind, std::string_view)>& onMessage) {
    constexpr std::size_t head = 1 + sizeof(std::uint64_t);
    std::size_t start = 0;
    while (buffer.size() - start >= head) {
        std::uint64_t length = 0;
        std::memcpy(&length, buffer.data() + start + 1, sizeof length);
        if (buffer.size() - start - head < length) break;
        const auto kind = static_cast<MessageKind>(buffer[start]);
        const std::string_view text(buffer.data() + start + head, length);
        if (kind == MessageKind::Error) {
            outcome.end = ChildOutcome::End::Error;
            outcome.error = text;
        } else if (kind == MessageKind::Result) {
            outcome.result += text;
        } else if (onMessage) {
            onMessage(kind, text);
        }
        start += head + length;
    }
    buffer.erase(0, start);
}

bool readSome(int descriptor, std::string& into) {
    static std::array<char, 1 << 16> block;
    const ssize_t count = ::read(descriptor, block.data(), block.size());
    if (count > 0) into.append(block.data(), static_cast<std::size_t>(count));
    return count > 0 || (count < 0 && errno == EINTR);
}

/// Reads both pipes until the child closes its message pipe, the deadline, or a signal.
void listen(const ChildLimits& limits, const Pipe& messages, const Pipe& prints, ChildOutcome& outcome,
            const std::function<void(MessageKind, std::string_view)>& onMessage) {
    std::string buffer;
    bool printsOpen = true;
    while (true) {
        pollfd waiting[2] = {{messages.readEnd, POLLIN, 0}, {printsOpen ? prints.readEnd : -1, POLLIN, 0}};
        const int ready = poll(waiting, 2, tickMilliseconds);
        if (caughtSignal != 0) {
            outcome.end = ChildOutcome::End::Interrupted;
            outcome.code = caughtSignal;
            return;
        }
        if (limits.deadline && std::chrono::steady_clock::now() >= *limits.deadline) {
            outcome.end = ChildOutcome::End::TimedOut;
            return;
        }
        if (ready <= 0) {
            if (onMessage) onMessage(MessageKind::Stage, {});
            continue;
        }
        if (waiting[1].revents != 0) {
            printsOpen = readSome(prints.readEnd, outcome.output);
            if (outcome.output.size() > 2 * keptOutput) outcome.output.erase(0, outcome.output.size() - keptOutput);
        }
        if (waiting[0].revents != 0) {
            if (!readSome(messages.readEnd, buffer)) return;
            dispatch(buffer, outcome, onMessage);
        }
    }
}

/// What was printed last may still be in the pipe; a grandchild may hold its other end open, so nothing is waited for.
void drain(const Pipe& prints, ChildOutcome& outcome) {
    pollfd waiting{prints.readEnd, POLLIN, 0};
    while (poll(&waiting, 1, 0) > 0 && (waiting.revents & POLLIN) != 0)
        if (!readSome(prints.readEnd, outcome.output)) break;
    if (outcome.output.size() > keptOutput) outcome.output.erase(0, outcome.output.size() - keptOutput);
}

}  // namespace

void MessagePipe::send(MessageKind kind, std::string_view text) const {
    std::string bytes(1, static_cast<char>(kind));
    const std::uint64_t length = text.size();
    bytes.append(reinterpret_cast<const char*>(&length), sizeof length);
    bytes.append(text);
    for (std::size_t sent = 0; sent < bytes.size();) {
        const ssize_t count = ::write(descriptor_, bytes.data() + sent, bytes.size() - sent);
        if (count < 0 && errno == EINTR) continue;
        if (count <= 0) _exit(1);
        sent += static_cast<std::size_t>(count);
    }
}

ChildOutcome runInChild(const ChildLimits& limits, const std::function<void(const MessagePipe&)>& work,
                        const std::function<void(MessageKind, std::string_view)>& onMessage) {
    Pipe messages, prints;
    SignalGuard guard;
    std::fflush(nullptr);  // else what is buffered would be printed twice
    const pid_t parent = getpid();
    const pid_t child = fork();
    if (child < 0) throw std::runtime_error("no process can be started: too many run already");
    if (child == 0) {
        guard.restore();
        childMain(limits, parent, messages, prints, work);
    }
    if (limits.ownProcessGroup) setpgid(child, child);  // on both sides, so that it holds whoever runs first
    messages.closeWrite();
    prints.closeWrite();

    ChildOutcome outcome;
    listen(limits, messages, prints, outcome, onMessage);
    const bool stopped = outcome.end == ChildOutcome::End::TimedOut || outcome.end == ChildOutcome::End::Interrupted;
    if (stopped) kill(limits.ownProcessGroup ? -child : child, SIGKILL);
    int status = 0;
    while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    drain(prints, outcome);
    if (stopped || outcome.end == ChildOutcome::End::Error) return outcome;
    if (WIFSIGNALED(status)) {
        outcome.end = ChildOutcome::End::Signal;
        outcome.code = WTERMSIG(status);
    } else if (WEXITSTATUS(status) != 0) {
        outcome.end = ChildOutcome::End::Exit;
        outcome.code = WEXITSTATUS(status);
    }
    return outcome;
}

}  // namespace tetralux::mesher
