// SPDX-License-Identifier: Apache-2.0
#include <preint/color_maps/color_maps.h>

#include <algorithm>
#include <charconv>
#include <stdexcept>

#include <fmt/format.h>

#include <preint/color_maps/color_map_table.h>
#include <preint/color_space.h>
#include <preint/similar_names.h>

namespace tetralux::preint {
namespace {

/// Names that others use, folded, and whose they are. "rainbow" is ParaView's, from blue to red; matplotlib's map of
/// that name has another one.
struct Alias {
    const char* alias;
    const char* name;
};
constexpr Alias aliases[] = {{"blackbody", "Black-Body Radiation"},
                             {"blackbodyradiation", "Black-Body Radiation"},
                             {"heat", "hot"},
                             {"rainbow", "Blue to Red Rainbow"},
                             {"bluetoredrainbow", "Blue to Red Rainbow"},
                             {"bluered", "bwr"},
                             {"divergent", "Cool to Warm"},
                             {"diverging", "Cool to Warm"},
                             {"moreland", "Cool to Warm"},
                             {"greyscale", "Grayscale"},
                             {"invertedgreyscale", "Inverted-Grayscale"},
                             {"xray", "X Ray"},
                             {"brewerqualitativeset1", "Set1"},
                             {"brewerqualitativeset2", "Set2"},
                             {"brewerqualitativeset3", "Set3"},
                             {"brewerqualitativeaccent", "Accent"},
                             {"brewerqualitativedark2", "Dark2"},
                             {"brewerqualitativepaired", "Paired"},
                             {"brewerqualitativepastel1", "Pastel1"},
                             {"brewerqualitativepastel2", "Pastel2"},
                             {"viridismatplotlib", "viridis"},
                             {"infernomatplotlib", "inferno"},
                             {"plasmamatplotlib", "plasma"},
                             {"magmamatplotlib", "magma"},
                             {"rainbowmatplotlib", "rainbow"},
                             {"matplotlibrainbow", "rainbow"},
                             {"categorical", "tab20"},
                             {"category10", "tab10"},
                             {"category20", "tab20"}};

const ColorMapText* named(std::string_view folded) {
    for (const auto* maps : {&matplotlibMaps(), &paraViewMaps()})
        for (const ColorMapText& map : *maps)
            if (foldedName(map.name) == folded) return &map;
    return nullptr;
}

const ColorMapText* found(std::string_view name) {
    const std::string folded = foldedName(name);
    for (const Alias& one : aliases)
        if (folded == one.alias) return named(foldedName(one.name));
    return named(folded);
}

constexpr std::string_view reversing = "_r";

struct Wanted {
    const ColorMapText* map = nullptr;
    bool reversed = false;
};

Wanted wantedMap(std::string_view name) {
    if (const ColorMapText* map = found(name)) return {map, false};
    const bool reversed =
        name.size() > reversing.size() && (name.ends_with(reversing) || name.ends_with("_R") || name.ends_with("-r"));
    if (!reversed) return {};
    return {found(name.substr(0, name.size() - reversing.size())), true};
}

double fractionFrom(const char* digits) {
    unsigned value = 0;
    std::from_chars(digits, digits + 4, value, 16);
    return value / 65535.0;
}

ColorSpace spaceOf(MapKind kind) {
    switch (kind) {
        case MapKind::Lab:
            return ColorSpace::Lab;
        case MapKind::Hsv:
            return ColorSpace::Hsv;
        case MapKind::Diverging:
            return ColorSpace::Diverging;
        case MapKind::Rgb:
        case MapKind::Categorical:
            break;
    }
    return ColorSpace::Rgb;
}

ColorMap readMap(const ColorMapText& text) {
    ColorMap map;
    map.name = text.name;
    const std::string_view digits = text.nodes;
    const std::size_t width = text.kind == MapKind::Categorical ? 12 : 16;
    for (std::size_t at = 0; at + width <= digits.size(); at += width) {
        const char* const node = digits.data() + at + (width - 12);
        const glm::dvec3 color(fractionFrom(node), fractionFrom(node + 4), fractionFrom(node + 8));
        if (text.kind == MapKind::Categorical)
            map.categories.push_back(color);
        else
            map.nodes.push_back({fractionFrom(digits.data() + at), color});
    }
    map.nodes = sampledInRgb(spaceOf(text.kind), map.nodes);
    return map;
}

void reverse(ColorMap& map) {
    map.name += reversing;
    std::reverse(map.categories.begin(), map.categories.end());
    std::reverse(map.nodes.begin(), map.nodes.end());
    for (ColorNode& node : map.nodes) node.scalar = 1.0 - node.scalar;
}

std::vector<std::string> everyName() {
    std::vector<std::string> names = presetNames();
    for (const std::string& name : colorMapNames())
        if (std::none_of(names.begin(), names.end(),
                         [&](const std::string& known) { return foldedName(known) == foldedName(name); }))
            names.push_back(name);
    return names;
}

}  // namespace

ColorMap colorMap(std::string_view name) {
    const Wanted wanted = wantedMap(name);
    if (wanted.map == nullptr) {
        const std::string meant = didYouMean(name, everyName());
        throw std::runtime_error(
            fmt::format("there is no colour map \"{}\";{} viridis, cool-to-warm, turbo, and all of matplotlib's and "
                        "ParaView's are there by their names, reversed with _r",
                        name, meant));
    }
    ColorMap map = readMap(*wanted.map);
    if (wanted.reversed) reverse(map);
    return map;
}

bool isColorMap(std::string_view name) {
    return wantedMap(name).map != nullptr;
}

std::vector<std::string> colorMapNames() {
    std::vector<std::string> names;
    for (const auto* maps : {&matplotlibMaps(), &paraViewMaps()})
        for (const ColorMapText& map : *maps)  // the name alone is ParaView's
            names.emplace_back(maps == &matplotlibMaps() && map.name == std::string_view("rainbow")
                                   ? "rainbow (matplotlib)"
                                   : map.name);
    return names;
}

}  // namespace tetralux::preint
