// SPDX-License-Identifier: Apache-2.0
/// \file
/// What gl_context.cpp chooses from; each kind stands in a file of its own. To add one: such a file, a line here and a
/// line in the list of gl_context.cpp.
#pragma once

#include <memory>

#include <projection/gl/gl_context.h>

namespace tetralux::projection {

/// \throws std::runtime_error saying why there is none.
std::unique_ptr<GlContext> makeEglContext();
std::unique_ptr<GlContext> makeOsMesaContext();

/// Versions to ask for, best first: all that is used is in 4.3.
struct GlVersion {
    int major, minor;
};
inline constexpr GlVersion glVersions[] = {{4, 6}, {4, 5}, {4, 3}};

}  // namespace tetralux::projection
