// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdio>
#include <string>

#include <fmt/format.h>

namespace tetralux::apps {

/// One line on standard error: something that the user should know, though there is a result. Errors are thrown.
inline void warn(const std::string& what) {
    fmt::print(stderr, "tetralux: warning: {}\n", what);
}

}  // namespace tetralux::apps
