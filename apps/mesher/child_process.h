// SPDX-License-Identifier: Apache-2.0
/// \file
/// Work done in a child process of its own, so that a library's crash, assert, exit or endless loop is an outcome among
/// others.
#pragma once

#include <chrono>
#include <cstdint>
#include <cstring>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace tetralux::mesher {

using Deadline = std::optional<std::chrono::steady_clock::time_point>;

/// What a child can tell its parent while it works.
enum class MessageKind : char { Stage = 'S', Note = 'N', Error = 'E', Result = 'R' };

/// The child's end of the pipe. Failing to write means that the parent is gone: the child ends.
class MessagePipe {
public:
    explicit MessagePipe(int descriptor) : descriptor_(descriptor) {}
    void send(MessageKind kind, std::string_view text) const;

private:
    int descriptor_;
};

struct ChildLimits {
    Deadline deadline;              ///< the child is killed then; none: no limit
    std::uint64_t memoryBytes = 0;  ///< address space (RLIMIT_AS); 0: no limit
    bool ownProcessGroup =
        false;  ///< so that killing the child kills its children, and Ctrl-C reaches the parent alone
};

/// How a child ended.
struct ChildOutcome {
    enum class End {
        Finished,     ///< `work` returned
        Error,        ///< `work` threw: `error` holds what() (one line)
        Signal,       ///< killed by signal `code`
        Exit,         ///< called exit with `code`
        TimedOut,     ///< killed at the deadline
        Interrupted,  ///< killed because this process got signal `code`
    };
    End end = End::Finished;
    int code = 0;
    std::string error;
    std::string result;  ///< all Result messages, one after the other
    std::string output;  ///< the last 4 KiB of what it printed
};

/// Forks and runs `work` in the child, its standard output and error caught. `onMessage` gets each Stage and Note
/// message, and an empty Stage about five times a second (to show that time goes by). While the child runs, SIGINT,
/// SIGTERM and SIGHUP are caught here and end the child. If this process dies, the child is killed (PR_SET_PDEATHSIG).
/// \throws std::runtime_error when no process or pipe can be made.
ChildOutcome runInChild(const ChildLimits& limits, const std::function<void(const MessagePipe&)>& work,
                        const std::function<void(MessageKind, std::string_view)>& onMessage = {});

/// Plain values to bytes and back, for results that travel through the pipe (same machine, same program).
template <class T>
void appendArray(std::string& bytes, const std::vector<T>& values) {
    const std::uint64_t count = values.size();
    bytes.append(reinterpret_cast<const char*>(&count), sizeof count);
    bytes.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
}

/// Takes the next array off the front of `bytes`. \throws std::runtime_error when the bytes end too early.
template <class T>
std::vector<T> takeArray(std::string_view& bytes) {
    std::uint64_t count = 0;
    if (bytes.size() < sizeof count) throw std::runtime_error("a child process returned too little");
    std::memcpy(&count, bytes.data(), sizeof count);
    bytes.remove_prefix(sizeof count);
    if (bytes.size() / sizeof(T) < count) throw std::runtime_error("a child process returned too little");
    std::vector<T> values(count);
    if (count > 0) std::memcpy(static_cast<void*>(values.data()), bytes.data(), count * sizeof(T));
    bytes.remove_prefix(count * sizeof(T));
    return values;
}

}  // namespace tetralux::mesher
