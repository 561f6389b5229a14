// SPDX-License-Identifier: Apache-2.0
/// \file
/// The reference of the command line: apps/COMMANDS.md and the manual page, of what CLI11 knows of every option and the
/// prose of command_reference.cpp.
#pragma once

#include <string>

namespace CLI {
class App;
}

namespace tetralux::apps {

/// `format`: "markdown", "man", or "bash" for its completion. \throws std::runtime_error for any other.
std::string commandReference(const CLI::App& program, const std::string& format);

}  // namespace tetralux::apps
