// SPDX-License-Identifier: Apache-2.0
/// \file
/// The subcommands of `tetralux`. To add one: a file with its `add…Command`, and one line in main.cpp.
#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace tetralux::apps {

/// What the subcommand that the user named does; the value is the exit status. Bad input is thrown as
/// std::runtime_error.
using Command = std::function<int()>;

// Each adds its subcommand and options to `program`; when the command line names it, `chosen` is set.
void addRenderCommand(CLI::App& program, Command& chosen);
void addInfoCommand(CLI::App& program, Command& chosen);
void addExtractCommand(CLI::App& program, Command& chosen);
void addBenchCommand(CLI::App& program, Command& chosen);
void addColorsCommand(CLI::App& program, Command& chosen);
void addCompareCommand(CLI::App& program, Command& chosen);
void addViewCommand(CLI::App& program, Command& chosen);

}  // namespace tetralux::apps
