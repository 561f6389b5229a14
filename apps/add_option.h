// SPDX-License-Identifier: Apache-2.0
/// \file
/// Options whose value is checked when it is read, so that the message can name the option and what to give.
#pragma once

#include <cmath>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

namespace tetralux::apps {

/// An option whose text `parse(name, text)` turns into `target`.
template <class Target, class Parse>
CLI::Option* addParsed(CLI::App& command, const std::string& name, Target& target, Parse parse, const std::string& help,
                       const std::string& form) {
    return command
        .add_option_function<std::string>(
            name, [&target, parse, name](const std::string& text) { target = parse(name, text); }, help)
        ->type_name(form);
}

/// A finite number for which `good` holds; `wanted` says in words which ones those are.
template <class Number, class Target>
CLI::Option* addNumber(CLI::App& command, const std::string& name, Target& target, bool (*good)(double),
                       const std::string& wanted, const std::string& help) {
    const auto store = [&target, good, wanted, name](const Number& value) {
        const auto number = static_cast<double>(value);
        if (!std::isfinite(number) || !good(number))
            throw std::runtime_error(fmt::format("{}: {} will not do; give {}", name, value, wanted));
        target = value;
    };
    return command.add_option_function<Number>(name, store, help);
}

/// An option that may be given several times; each text is handed to `take`.
inline void addRepeated(CLI::App& command, const std::string& name, const std::string& form, const std::string& help,
                        const std::function<void(const std::string&)>& take) {
    command
        .add_option_function<std::vector<std::string>>(
            name,
            [take](const std::vector<std::string>& texts) {
                for (const std::string& text : texts) take(text);
            },
            help)
        ->type_name(form)
        ->allow_extra_args(false);
}

inline bool positive(double value) {
    return value > 0.0;
}
inline bool notNegative(double value) {
    return value >= 0.0;
}

}  // namespace tetralux::apps
