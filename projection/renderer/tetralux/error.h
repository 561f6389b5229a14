// SPDX-License-Identifier: Apache-2.0
/// \file
/// The one exception of the library.
#pragma once

#include <stdexcept>
#include <string>

namespace tetralux {

/// What kind of error it is, for programs; people read Error::what().
enum class Errc {
    BadInput,     ///< an argument, an array or a file is not what it must be
    Unsupported,  ///< asked for rightly, but this build or machine cannot do it
    OutOfMemory,  ///< a smaller mesh, picture or table may do
    DeviceLost,   ///< the OpenGL context is gone
    Cancelled     ///< by the caller's stop token, in what has no result to give back
};

/// The only exception that leaves the library. what() is one line: what is wrong, where, and what would mend it.
class Error : public std::runtime_error {
public:
    /// `what`: one line.
    Error(Errc code, const std::string& what) : std::runtime_error(what), code_(code) {}
    Errc code() const noexcept { return code_; }  ///< what kind of error

private:
    Errc code_;
};

}  // namespace tetralux
