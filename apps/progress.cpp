// SPDX-License-Identifier: Apache-2.0
#include <apps/progress.h>

#include <unistd.h>

#include <cstdio>
#include <string>

#include <fmt/format.h>

namespace tetralux::apps {

ProgressBar::ProgressBar(int steps, bool wanted) : steps_(steps), shown_(wanted && ::isatty(STDERR_FILENO) == 1) {
    show(0);
}

ProgressBar::~ProgressBar() {
    if (shown_) fmt::print(stderr, "\r\x1b[K");
}

void ProgressBar::show(int stepsDone) {
    if (!shown_) return;
    constexpr int width = 40;  // characters
    const int filled = width * stepsDone / steps_;
    std::string left;
    if (stepsDone > 0) {
        const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
        left = fmt::format(", {:.0f} s left", seconds * (steps_ - stepsDone) / stepsDone);
    }
    fmt::print(stderr, "\r[{:#<{}}{:.<{}}] {}/{}{}\x1b[K", "", filled, "", width - filled, stepsDone, steps_, left);
    std::fflush(stderr);
}

}  // namespace tetralux::apps
