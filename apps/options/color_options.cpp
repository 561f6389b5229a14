// SPDX-License-Identifier: Apache-2.0
#include <apps/options/color_options.h>

#include <charconv>
#include <filesystem>
#include <stdexcept>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <CLI/CLI.hpp>

#include <apps/add_option.h>
#include <apps/option_values.h>
#include <preint/color_maps/color_maps.h>
#include <preint/opacity_words.h>
#include <preint/similar_names.h>
#include <projection/frame/suggested_extinction.h>

namespace tetralux::apps {

namespace {

/// "C,W": from C − W/2 to C + W/2. "dicom:C,W" counts in whole numbers, of which a window of width W holds W (DICOM
/// PS3.3, C.11.2.1.2.1): from C − 1/2 − (W − 1)/2 to C − 1/2 + (W − 1)/2.
glm::dvec2 parseWindow(const std::string& option, const std::string& text) {
    constexpr std::string_view dicom = "dicom:";
    const bool whole = text.starts_with(dicom);
    const std::vector<double> values =
        parseNumbers(option, whole ? text.substr(dicom.size()) : text, 2, "centre,width or dicom:centre,width");
    if (whole && !(values[1] >= 1.0))
        throw std::runtime_error(fmt::format(
            "{}: '{}' is narrower than one whole number; give dicom:centre,width with a width from 1", option, text));
    if (whole) return {values[0] - 0.5 - 0.5 * (values[1] - 1.0), values[0] - 0.5 + 0.5 * (values[1] - 1.0)};
    if (!(values[1] > 0.0))
        throw std::runtime_error(
            fmt::format("{}: '{}' has no width; give centre,width with a width above 0", option, text));
    return {values[0] - 0.5 * values[1], values[0] + 0.5 * values[1]};
}

glm::dvec2 parseRange(const std::string& option, const std::string& text) {
    const std::vector<double> ends = parseNumbers(option, text, 2, "low,high");
    if (!(ends[0] < ends[1]))
        throw std::runtime_error(fmt::format("{}: {} is not below {}; give low,high", option, ends[0], ends[1]));
    return {ends[0], ends[1]};
}

void addRangeOption(CLI::App& command, ColorOptions& options) {
    command
        .add_option_function<std::string>(
            "--range",
            [&options](const std::string& text) {
                if (options.words.range)
                    throw std::runtime_error("--range: the range is given already; leave --range or --window out");
                options.rangeOfAllSteps = text == "all";
                if (!options.rangeOfAllSteps) options.words.range = parseRange("--range", text);
            },
            "scalars from the first to the last colour; all: those of every step of a series; default: the range of "
            "the "
            "field in the step that is drawn")
        ->type_name("low,high|all");
}

/// A number scales, anything else is a word.
void readOpacity(const std::string& text, preint::FunctionWords& words) {
    double factor = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), factor);
    if (error == std::errc() && end == text.data() + text.size()) {
        words.opacityScale = factor;
    } else {
        words.opacity = text;
    }
    try {
        preint::withWords({}, words);  // refuses now rather than after reading
    } catch (const std::runtime_error& refused) {
        throw std::runtime_error(fmt::format("--opacity {}: {}", text, refused.what()));
    }
}

/// Nothing, the name of a colour map, a file or the text of one; a map's name wins over a file of that name.
preint::TransferFunction loadTransferFunction(const std::string& name) {
    if (name.empty()) return projection::defaultTransferFunction();
    if (preint::isColorMap(name)) return preint::preset(name);
    if (name.front() == '{') return preint::parseTransferFunction(name, "--tf");
    std::error_code ignored;
    if (std::filesystem::exists(name, ignored) && !std::filesystem::is_directory(name, ignored))
        return preint::readTransferFunction(name);
    std::vector<std::string> names = preint::presetNames();
    for (std::string& other : preint::colorMapNames()) names.push_back(std::move(other));
    throw std::runtime_error(
        fmt::format("--tf {}: no such file or colour map;{} give a JSON file, {} or another name of `tetralux colors`",
                    name, preint::didYouMean(name, names), fmt::join(preint::presetNames(), ", ")));
}

}  // namespace

void addColorOptions(CLI::App& command, ColorOptions& options) {
    command.add_option(
        "--tf", options.transferFunction,
        fmt::format(
            "transfer function file (JSON, ParaView, VisIt), JSON itself, '{{\"color\": …}}', or colours by name: {} "
            "or any other of matplotlib's and "
            "ParaView's (`tetralux colors` lists them), in any case, with _r reversed; opacity is then suggested; "
            "default: cool-to-warm",
            fmt::join(preint::presetNames(), ", ")));
    command
        .add_option_function<std::vector<std::string>>(
            "--opacity",
            [&options](const std::vector<std::string>& texts) {
                for (const std::string& text : texts) readOpacity(text, options.words);
            },
            fmt::format(
                "a number scales the opacity (extinction times F); a word sets it over the range, as PyVista has them: "
                "{}, _r reverses; both: give it twice",
                fmt::join(preint::opacityWords(), ", ")))
        ->type_name("F|WORD")
        ->allow_extra_args(false);
    addNumber<double>(command, "--opacity-distance", options.words.unitDistance, positive, "a length above 0",
                      "length over which the opacity of a word counts, mesh units; default: 1/50 of the diagonal");
    addRangeOption(command, options);
    addParsed(
        command, "--window", options.words.range,
        [&options](const std::string& option, const std::string& text) {
            if (options.words.range || options.rangeOfAllSteps)
                throw std::runtime_error("--window: the range is given already; leave --range or --window out");
            return parseWindow(option, text);
        },
        "the same by its centre and width; dicom: as DICOM defines it for whole numbers", "[dicom:]centre,width");
    command.add_flag("--log", options.words.logScale, "colours and opacity over the logarithm of the scalar");
}

preint::TransferFunction transferFunctionFor(const ColorOptions& options) {
    preint::TransferFunction function = loadTransferFunction(options.transferFunction);
    if (options.words.logScale && !function.normalized && !options.words.range)
        throw std::runtime_error(
            fmt::format("--log: {} names its own scalars, so there is nothing to stretch; give --range low,high, or "
                        "leave --log out",
                        options.transferFunction));
    try {
        return preint::withWords(std::move(function), options.words);
    } catch (const std::runtime_error& error) {
        throw std::runtime_error(fmt::format("--{}", error.what()));
    }
}

}  // namespace tetralux::apps
