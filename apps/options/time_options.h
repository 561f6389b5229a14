// SPDX-License-Identifier: Apache-2.0
/// \file
/// Pictures of a series of steps: --times, --fps.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace tetralux::apps {

struct TimeOptions {
    std::string times;            ///< "", "all" or "first:last[:every]"
    double framesPerSecond = 25;  ///< of films
};

void addTimeOptions(CLI::App& command, TimeOptions& options);

/// The numbers of the steps that are asked for, of `count`, counted from 0. \throws std::runtime_error for others.
std::vector<std::size_t> chosenSteps(const TimeOptions& options, std::size_t count);

}  // namespace tetralux::apps
