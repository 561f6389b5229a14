// SPDX-License-Identifier: Apache-2.0
#include <projection/gl/gl_path.h>

#include <algorithm>
#include <array>
#include <optional>
#include <stdexcept>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace tetralux::projection {

std::vector<std::string> glPathNames() {
    return {"auto", "stream", "resident", "tiles", "measured"};
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

GlPathChoice chooseGlPath(GlPath wanted, std::string_view renderer, const std::function<void()>& keepCells,
                          const std::function<void()>& makeTiles) {
    if (wanted == GlPath::Stream) return {GlPath::Stream, "asked for"};
    if (wanted == GlPath::Auto && isSoftwareRenderer(renderer)) return {GlPath::Stream, "software renderer"};
    const auto refusal = [&](const std::function<void()>& make) -> std::optional<std::string> {
        try {
            make();
            return std::nullopt;
        } catch (const std::runtime_error& error) {
            if (wanted != GlPath::Auto) throw;
            return error.what();
        }
    };
    if (const auto refused = refusal(keepCells)) return {GlPath::Stream, *refused};
    if (wanted == GlPath::Resident) return {GlPath::Resident, "asked for"};
    if (const auto refused = refusal(makeTiles)) return {GlPath::Resident, *refused};
    if (wanted == GlPath::Tiles) return {GlPath::Tiles, "asked for"};
    return {GlPath::Measured, wanted == GlPath::Auto ? "GPU" : "asked for"};
}

}  // namespace tetralux::projection
