// SPDX-License-Identifier: Apache-2.0
//
// tetralux colors: the colour maps that there are, as a list or as a picture.
#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <apps/commands.h>
#include <apps/overlay.h>
#include <preint/color_maps/color_maps.h>
#include <projection/image/image.h>

namespace tetralux::apps {

namespace {

struct ColorsOptions {
    std::vector<std::string> names;
    std::string output;
};

std::vector<preint::ColorMap> chosenMaps(const ColorsOptions& options) {
    std::vector<preint::ColorMap> maps;
    for (const std::string& name : options.names.empty() ? preint::colorMapNames() : options.names)
        maps.push_back(preint::colorMap(name));
    return maps;
}

void drawMap(const preint::ColorMap& map, const glm::dvec2& corner, const glm::dvec2& size, Overlay& overlay) {
    preint::TransferFunction function;
    function.color = map.nodes;
    const int steps = map.categories.empty() ? static_cast<int>(size.x) : static_cast<int>(map.categories.size());
    for (int i = 0; i < steps; ++i) {
        const glm::dvec3 color =
            map.categories.empty() ? function.colorAt((i + 0.5) / steps) : map.categories[static_cast<std::size_t>(i)];
        overlay.fill(corner + glm::dvec2(size.x * i / steps, 0), {size.x / steps, size.y}, color);
    }
}

/// In columns, each map a bar with its name beside it.
void drawChart(const std::vector<preint::ColorMap>& maps, const std::string& path) {
    constexpr int bar = 180, label = 280, row = 22, gap = 8, mostRows = 50;
    const int count = static_cast<int>(maps.size());
    const int columns = (count + mostRows - 1) / mostRows, rows = (count + columns - 1) / columns;
    const int width = columns * (bar + label) + gap, height = rows * row + gap;
    Overlay overlay(width, height, glm::dvec3(0));
    for (int i = 0; i < count; ++i) {
        const glm::dvec2 corner(gap + i / rows * (bar + label), gap + i % rows * row);
        drawMap(maps[static_cast<std::size_t>(i)], corner, {bar, row - gap}, overlay);
        overlay.text(corner + glm::dvec2(bar + gap, 0.5 * (row - gap)), maps[static_cast<std::size_t>(i)].name, 13.0,
                     {0.0, 0.5});
    }
    projection::Image chart(width, height);
    projection::putUnder(chart, glm::vec3(1));
    overlay.putOver(chart);
    projection::writeImage(chart, path);
}

int colors(const ColorsOptions& options) {
    if (!options.output.empty()) projection::checkImagePath(options.output);
    const std::vector<preint::ColorMap> maps = chosenMaps(options);
    if (!options.output.empty()) {
        drawChart(maps, options.output);
        return 0;
    }
    for (const preint::ColorMap& map : maps)
        fmt::print("{}{}\n", map.name,
                   map.categories.empty() ? "" : fmt::format(" ({} colours for ids)", map.categories.size()));
    return 0;
}

}  // namespace

void addColorsCommand(CLI::App& program, Command& chosen) {
    const auto options = std::make_shared<ColorsOptions>();
    CLI::App* command = program.add_subcommand("colors", "the colour maps that --tf knows, as a list or a picture");
    command->add_option("NAME", options->names, "these alone; in any case, _r reverses; default: all");
    command->add_option("-o,--output", options->output, "draw them: .png or .exr");
    command->callback([options, &chosen] { chosen = [options] { return colors(*options); }; });
}

}  // namespace tetralux::apps
