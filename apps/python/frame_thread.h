// SPDX-License-Identifier: Apache-2.0
/// \file
/// Where frames are drawn: a thread beside the one that waits for them.
#pragma once

#include <condition_variable>
#include <deque>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <stop_token>
#include <thread>

namespace tetralux::python {

/// One thread for all that a renderer does, one after the other: whoever waits can hear Ctrl-C meanwhile, and OpenGL
/// contexts stay in the thread that made them.
class FrameThread {
public:
    FrameThread();
    ~FrameThread() { close(); }
    FrameThread(const FrameThread&) = delete;
    FrameThread& operator=(const FrameThread&) = delete;

    /// Runs `work` and returns when it has ended, throwing what it threw. Holds the interpreter's lock before and
    /// after, not meanwhile. Where the handler of a signal raises (KeyboardInterrupt), asks `stop` to end the work and
    /// throws that within some 20 ms, whether or not the work has ended; so work owns what it uses.
    void run(std::function<void()> work, std::stop_source stop = {});

    /// Ends when all is done and nobody waits any longer: before the interpreter does, which a thread must not meet
    /// when it asks for its lock. Holds that lock before and after.
    void close();

private:
    struct Job {
        std::function<void()> work;
        std::exception_ptr error;
        bool done = false;
    };

    struct Waiting;
    void serve(const std::stop_token& end);

    std::mutex mutex_;
    std::condition_variable_any posted_;
    std::condition_variable ended_;
    std::deque<std::shared_ptr<Job>> jobs_;
    int waiting_ = 0;  ///< threads within run()
    int process_;      ///< threads do not live on in a forked one
    std::jthread thread_;
};

}  // namespace tetralux::python
