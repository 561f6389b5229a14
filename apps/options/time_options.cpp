// SPDX-License-Identifier: Apache-2.0
#include <apps/options/time_options.h>

#include <algorithm>
#include <charconv>
#include <stdexcept>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <apps/add_option.h>

namespace tetralux::apps {

namespace {

constexpr const char* form = "all or first:last[:every], steps counted from 0, -1 the last";

/// Whole numbers between colons.
std::vector<long> numbersOf(const std::string& text) {
    std::vector<long> numbers;
    const char *at = text.data(), *const end = text.data() + text.size();
    while (true) {
        long number = 0;
        const auto [stop, error] = std::from_chars(at, end, number);
        if (error != std::errc() || (stop != end && *stop != ':'))
            throw std::runtime_error(fmt::format("--times: '{}' names no steps; give {}", text, form));
        numbers.push_back(number);
        if (stop == end) return numbers;
        at = stop + 1;
    }
}

}  // namespace

void addTimeOptions(CLI::App& command, TimeOptions& options) {
    addParsed(
        command, "--times", options.times,
        [](const std::string&, const std::string& text) {
            if (text != "all") numbersOf(text);
            return text;
        },
        "one picture of each of these steps of a series (`info` lists them): OUT_0000.png, OUT_0001.png, ...; steps "
        "count "
        "from 0, -1 is the last",
        "all|FIRST:LAST[:EVERY]");
    addNumber<double>(
        command, "--fps", options.framesPerSecond, [](double value) { return value > 0.0 && value <= 1000.0; },
        "a number above 0, up to 1000", "pictures per second of a film, 25");
}

std::vector<std::size_t> chosenSteps(const TimeOptions& options, std::size_t count) {
    std::vector<std::size_t> steps;
    if (count == 0) throw std::runtime_error("--times: it is no series; leave it out");
    if (options.times == "all") {
        for (std::size_t step = 0; step < count; ++step) steps.push_back(step);
        return steps;
    }
    const std::vector<long> numbers = numbersOf(options.times);
    const auto stepOf = [&](long number) {
        const long step = number < 0 ? number + static_cast<long>(count) : number;
        if (step < 0 || step >= static_cast<long>(count))
            throw std::runtime_error(
                fmt::format("--times: there is no step {}; the series has {}, from 0 to {}", number, count, count - 1));
        return step;
    };
    const long every = numbers.size() > 2 ? numbers[2] : 1;
    if (numbers.size() > 3 || every < 1)
        throw std::runtime_error(fmt::format("--times: '{}' names no steps; give {}", options.times, form));
    const long first = stepOf(numbers.front()), last = stepOf(numbers.size() > 1 ? numbers[1] : numbers[0]);
    if (last < first)
        throw std::runtime_error(fmt::format("--times: step {} comes after step {}; give first:last", first, last));
    for (long step = first; step <= last; step += every) steps.push_back(static_cast<std::size_t>(step));
    return steps;
}

}  // namespace tetralux::apps
