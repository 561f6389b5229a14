// SPDX-License-Identifier: Apache-2.0
#include <projection/gl_path.h>

#include <algorithm>
#include <array>
#include <stdexcept>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace tetralux::projection {

std::vector<std::string> glPathNames() {
    return {"auto", "stream", "resident"};
}

GlPath parseGlPath(std::string_view name) {
    const std::vector<std::string> names = glPathNames();
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end())
        throw std::runtime_error(
            fmt::format("GL path '{}': there is no such; take one of {}", name, fmt::join(names, ", ")));
    return static_cast<GlPath>(found - names.begin());
}

bool isSoftwareRenderer(std::string_view renderer) {
    constexpr std::array<std::string_view, 5> names{"llvmpipe", "softpipe", "SWR", "swrast", "Software Rasterizer"};
    return std::any_of(names.begin(), names.end(),
                       [&](std::string_view name) { return renderer.find(name) != std::string_view::npos; });
}

}  // namespace tetralux::projection
