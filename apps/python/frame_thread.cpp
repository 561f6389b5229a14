// SPDX-License-Identifier: Apache-2.0
#include <apps/python/frame_thread.h>

#include <unistd.h>

#include <chrono>
#include <optional>
#include <utility>

#include <nanobind/nanobind.h>

#include <tetralux/error.h>

namespace tetralux::python {

namespace nb = nanobind;
using namespace std::chrono_literals;

FrameThread::FrameThread() : process_(getpid()), thread_([this](const std::stop_token& end) { serve(end); }) {}

void FrameThread::close() {
    if (!thread_.joinable()) return;
    if (getpid() != process_) {
        thread_.detach();  // it is the parent's
        return;
    }
    const nb::gil_scoped_release unlocked;
    thread_.request_stop();
    thread_.join();
    std::unique_lock lock(mutex_);
    ended_.wait(lock, [&] { return waiting_ == 0; });
}

void FrameThread::serve(const std::stop_token& end) {
    std::unique_lock lock(mutex_);
    while (posted_.wait(lock, end, [&] { return !jobs_.empty(); })) {
        const std::shared_ptr<Job> job = std::move(jobs_.front());
        jobs_.pop_front();
        lock.unlock();
        try {
            job->work();
        } catch (...) {
            job->error = std::current_exception();
        }
        job->work = nullptr;
        lock.lock();
        job->done = true;
        ended_.notify_all();
    }
}

/// Counts a thread while it is within run(); the last act of which is to leave, holding the interpreter's lock.
struct FrameThread::Waiting {
    FrameThread& thread;
    explicit Waiting(FrameThread& t) : thread(t) { count(1); }
    ~Waiting() { count(-1); }
    Waiting(const Waiting&) = delete;
    Waiting& operator=(const Waiting&) = delete;

    void count(int change) {
        const std::lock_guard lock(thread.mutex_);
        thread.waiting_ += change;
        thread.ended_.notify_all();
    }
};

void FrameThread::run(std::function<void()> work, std::stop_source stop) {
    constexpr auto betweenSignals = 10ms, patience = 20ms;
    if (getpid() != process_)
        throw Error(Errc::Unsupported,
                    "renderer: it was made before the process forked; make one in this process instead");
    if (!thread_.joinable()) throw Error(Errc::Unsupported, "renderer: it was closed; make another one");
    const auto job = std::make_shared<Job>();
    job->work = std::move(work);
    const Waiting waiting{*this};
    std::optional<nb::python_error> raised;
    {
        const nb::gil_scoped_release unlocked;
        std::unique_lock lock(mutex_);
        jobs_.push_back(job);
        posted_.notify_one();
        const auto isDone = [&] { return job->done; };
        while (!raised && !ended_.wait_for(lock, betweenSignals, isDone)) {
            lock.unlock();
            {
                const nb::gil_scoped_acquire locked;
                if (PyErr_CheckSignals() != 0) raised.emplace();
            }
            lock.lock();
        }
        if (raised) {
            stop.request_stop();
            ended_.wait_for(lock, patience, isDone);
        }
    }
    if (raised) throw nb::python_error(std::move(*raised));
    if (job->error) std::rethrow_exception(job->error);
}

}  // namespace tetralux::python
