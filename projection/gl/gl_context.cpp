// SPDX-License-Identifier: Apache-2.0
#include <projection/gl/gl_context.h>

#include <stdexcept>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <projection/gl/gl_context_kinds.h>

namespace tetralux::projection {
namespace {

struct ContextKind {
    const char* name;
    const char* packages;  // Debian packages that bring it
    std::unique_ptr<GlContext> (*make)();
};

// In the order in which "auto" tries them.
constexpr ContextKind contextKinds[] = {
    {"egl", "libegl1 libgl1-mesa-dri", makeEglContext},
    {"osmesa", "libosmesa6", makeOsMesaContext},
};

}  // namespace

std::vector<std::string> glContextNames() {
    std::vector<std::string> names{"auto"};
    for (const ContextKind& kind : contextKinds) names.emplace_back(kind.name);
    return names;
}

std::unique_ptr<GlContext> makeGlContext(const std::string& kind) {
    std::string reasons, packages;
    for (const ContextKind& candidate : contextKinds) {
        if (kind != "auto" && kind != candidate.name) continue;
        try {
            return candidate.make();
        } catch (const std::runtime_error& error) {
            reasons += (reasons.empty() ? "" : "; ") + std::string(error.what());
            packages += (packages.empty() ? "" : ", or ") + std::string(candidate.packages);
        }
    }
    if (packages.empty()) {
        throw std::runtime_error(
            fmt::format("context '{}': no such kind; choose one of {}", kind, fmt::join(glContextNames(), ", ")));
    }
    throw std::runtime_error(
        fmt::format("no OpenGL 4.3 context ({}); install the Debian packages {}", reasons, packages));
}

}  // namespace tetralux::projection
