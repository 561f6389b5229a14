// SPDX-License-Identifier: Apache-2.0
/// \file
/// What whoever waits for a frame may do meanwhile: stop it, and hear how far it is.
#pragma once

#include <exception>
#include <functional>
#include <stop_token>

namespace tetralux::projection {

/// A frame was stopped on request. Engines are ready for the next one.
struct FrameStopped : std::exception {
    const char* what() const noexcept override { return "the frame was stopped"; }
};

struct FrameControl {
    std::stop_token stop;
    std::function<void(double)> progress;  ///< share of the frame that is done, 0 … 1; by the thread that asked for it

    /// Asked by every task of a frame: once for each tile or some thousand cells. \throws FrameStopped
    void check() const {
        if (stop.stop_requested()) throw FrameStopped();
    }
};

/// The same where there may be nobody who waits.
inline void checkStop(const FrameControl* control) {
    if (control != nullptr) control->check();
}

inline void tellProgress(const FrameControl* control, double share) {
    if (control != nullptr && control->progress) control->progress(share);
}

}  // namespace tetralux::projection
