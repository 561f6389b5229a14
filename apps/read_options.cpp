// SPDX-License-Identifier: Apache-2.0
#include <apps/read_options.h>

#include <apps/add_option.h>

namespace tetralux::apps {

void addReadOptions(CLI::App& command, mesh::ReadOptions& options) {
    addNumber<double>(
        command, "--time", options.time, [](double) { return true; }, "a finite number",
        "time of a series; the step nearest to it is taken");
    addNumber<int>(
        command, "--subdivide", options.subdivision, [](double value) { return value >= 1.0 && value <= 64.0; },
        "a whole number from 1 to 64", "pieces along each edge of a curved cell; default: its order");
    addNumber<double>(command, "--merge", options.mergeTolerance, notNegative, "a length in mesh units, from 0",
                      "points within this distance become one");
    options.isolated = true;
    command.add_flag("--smooth-cells", options.smoothCells,
                     "cell fields become point fields, by averaging over the cells at a point");
}

}  // namespace tetralux::apps
