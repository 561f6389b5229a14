// SPDX-License-Identifier: Apache-2.0
#include <apps/options/part_options.h>

#include <charconv>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <apps/add_option.h>
#include <apps/option_values.h>

namespace tetralux::apps {

namespace {

std::optional<double> numberIn(std::string_view text) {
    double number = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc() || end != text.data() + text.size() || std::isnan(number)) return std::nullopt;
    return number;
}

/// "FIELD:low:high"; either end may be missing, and the field's name may have colons.
mesh::Threshold parseThreshold(const std::string& text) {
    const auto refuse = [&] {
        return std::runtime_error(
            fmt::format("--threshold: '{}' is no range of a field; give FIELD:LOW:HIGH, such as T:300:900 or T:300: "
                        "for 300 and more",
                        text));
    };
    const std::size_t second = text.rfind(':');
    if (second == std::string::npos || second == 0) throw refuse();
    const std::size_t first = text.rfind(':', second - 1);
    if (first == std::string::npos || first == 0) throw refuse();
    const std::string low = text.substr(first + 1, second - first - 1), high = text.substr(second + 1);
    mesh::Threshold threshold{text.substr(0, first), -std::numeric_limits<double>::infinity(),
                              std::numeric_limits<double>::infinity()};
    if (low.empty() && high.empty()) throw refuse();
    for (const auto& [end, value] : {std::pair(&low, &threshold.low), std::pair(&high, &threshold.high)}) {
        if (end->empty()) continue;
        const auto number = numberIn(*end);
        if (!number) throw refuse();
        *value = *number;
    }
    if (!(threshold.low <= threshold.high))
        throw std::runtime_error(
            fmt::format("--threshold: {} is above {}; give FIELD:LOW:HIGH", threshold.low, threshold.high));
    return threshold;
}

/// "FIELD" or "FIELD:F".
mesh::Warp parseWarp(const std::string&, const std::string& text) {
    const std::size_t colon = text.rfind(':');
    if (colon != std::string::npos && colon > 0)
        if (const auto factor = numberIn(std::string_view(text).substr(colon + 1)); factor && std::isfinite(*factor))
            return {text.substr(0, colon), *factor};
    return {text, 1.0};
}

glm::dvec3 parseScale(const std::string& option, const std::string& text) {
    if (const auto one = numberIn(text); one && std::isfinite(*one) && *one != 0.0) return glm::dvec3(*one);
    const glm::dvec3 factors = parseVector(option, text);
    if (factors.x * factors.y * factors.z == 0.0)
        throw std::runtime_error(fmt::format("{}: '{}' makes the mesh flat; give factors other than 0", option, text));
    return factors;
}

/// Names with commas between them.
void addNames(CLI::App& command, const std::string& name, std::vector<std::string>& names, const std::string& help) {
    command.add_option(name, names, help)->delimiter(',')->type_name("NAME,...")->allow_extra_args(false);
}

}  // namespace

void addPartOptions(CLI::App& command, mesh::MeshShaping& shaping) {
    addNames(command, "--blocks", shaping.blocks,
             "these blocks (parts, zones, groups) alone, by name or number; `info` lists them");
    addNames(command, "--hide-blocks", shaping.hiddenBlocks, "all but these blocks");
    command
        .add_option_function<std::vector<std::string>>(
            "--threshold",
            [&shaping](const std::vector<std::string>& texts) {
                for (const std::string& text : texts) shaping.thresholds.push_back(parseThreshold(text));
            },
            "the cells alone all of whose values of the field lie in the range; may be given several times")
        ->type_name("FIELD:LOW:HIGH")
        ->allow_extra_args(false);
    addParsed(command, "--warp", shaping.warp, parseWarp,
              "moves each point by the field, a vector on points, times the factor, 1", "FIELD[:FACTOR]");
    addParsed(command, "--scale", shaping.scale, parseScale,
              "stretches the mesh along its axes, for flat domains; one factor for all, or three", "x,y,z");
}

}  // namespace tetralux::apps
