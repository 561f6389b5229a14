// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace tetralux::mesh {

/// Runs a program (found on PATH unless it has a slash) to its end, with what it prints going to the file `output`. It
/// stays in the terminal's group, so that Ctrl-C ends both. \throws std::runtime_error naming the program, how it ended
/// and its last line, unless its exit status is 0.
void runProgram(const std::vector<std::string>& commandLine, const std::string& output);

}  // namespace tetralux::mesh
