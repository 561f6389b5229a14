// SPDX-License-Identifier: Apache-2.0
/// \file
/// Colour and opacity of the scalar: --tf, --opacity, --range, --window, --log.
#pragma once

#include <string>

#include <preint/function_words.h>

namespace CLI {
class App;
}

namespace tetralux::apps {

struct ColorOptions {
    std::string transferFunction;  ///< file or colour map; empty: the default
    preint::FunctionWords words;   ///< what else is said of it
    bool rangeOfAllSteps = false;  ///< its range is that of the field over all steps of a series
};

void addColorOptions(CLI::App& command, ColorOptions& options);

/// What they ask for, not yet fitted to a field. \throws std::runtime_error naming file or option.
preint::TransferFunction transferFunctionFor(const ColorOptions& options);

}  // namespace tetralux::apps
