// SPDX-License-Identifier: Apache-2.0
/// \file
/// Runs of `tetralux view --script`.
#pragma once

#include <istream>
#include <string>

#include <apps/view/option_words.h>

namespace tetralux::apps::view {

/// One command a line. \throws std::runtime_error naming `name` and the line; the commands before it have been run.
void runScript(std::istream& script, const std::string& name, OptionWords words);

}  // namespace tetralux::apps::view
