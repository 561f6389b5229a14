// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <utility>

#include <nanobind/nanobind.h>

namespace tetralux::python {

/// Keeps something of Python's alive for C++, whose last user may drop it in any thread, with or without the
/// interpreter's lock.
template <class Kept>
std::shared_ptr<const Kept> ownerOf(Kept kept) {
    return {new Kept(std::move(kept)), [](const Kept* last) {
                if (!nanobind::is_alive()) return;  // the interpreter has ended, and all its objects with it
                const nanobind::gil_scoped_acquire locked;
                delete last;
            }};
}

}  // namespace tetralux::python
