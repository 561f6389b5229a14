// SPDX-License-Identifier: Apache-2.0
/// \file
/// Internal: every exception that leaves the library is an Error.
#pragma once

#include <exception>
#include <new>
#include <utility>

#include <projection/core/frame_control.h>
#include <tetralux/error.h>

namespace tetralux::renderer {

/// What `work` returns; what it throws as an Error.
template <class Work>
decltype(auto) translated(const Work& work) {
    try {
        return work();
    } catch (const Error&) {
        throw;
    } catch (const projection::FrameStopped&) {
        throw Error(Errc::Cancelled, "stopped on request");
    } catch (const std::bad_alloc&) {
        throw Error(Errc::OutOfMemory, "out of memory; draw a smaller picture or mesh, or close other programs");
    } catch (const std::exception& error) {
        throw Error(Errc::BadInput, error.what());
    }
}

}  // namespace tetralux::renderer
