// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>

#include <nlohmann/json_fwd.hpp>

#include "child_process.h"
#include "options.h"

namespace tetralux::mesher {

/// What the work says while it runs.
struct Listener {
    std::function<void(const std::string&)> stage;  ///< what is being done: "meshing"
    std::function<void(const std::string&)> note;   ///< a line of the account for people
};

/// Everything between input and output: reads, checks, mends, makes tetrahedra, adds fields, coarsens, and writes to
/// `temporary`. Returns the account for machines. \throws std::runtime_error with one line that names the input and
/// what would mend it.
nlohmann::json makeMesh(const Options& options, const std::string& temporary, const Deadline& deadline,
                        const Listener& listener);

}  // namespace tetralux::mesher
