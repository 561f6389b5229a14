// SPDX-License-Identifier: Apache-2.0
/// \file
/// What bash completes after `tetralux`, of the same options as the reference page.
#pragma once

#include <string>

namespace CLI {
class App;
}

namespace tetralux::apps {

/// A script for bash: commands, a command's options, and the words that an option takes where its help lists them;
/// file names anywhere else.
std::string bashCompletion(const CLI::App& program);

}  // namespace tetralux::apps
