// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>

namespace tetralux::apps {

/// A bar on standard error: drawn only when that is a terminal and `wanted`, wiped when it goes.
class ProgressBar {
public:
    ProgressBar(int steps, bool wanted);
    ~ProgressBar();
    ProgressBar(const ProgressBar&) = delete;
    ProgressBar& operator=(const ProgressBar&) = delete;

    void show(int stepsDone);

private:
    int steps_;
    bool shown_;
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace tetralux::apps
