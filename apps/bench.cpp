// SPDX-License-Identifier: Apache-2.0
//
// tetralux bench: run time against error, all engines and VTK's in one table.
#include <unistd.h>

#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <apps/bench_machine.h>
#include <apps/bench_options.h>
#include <apps/bench_output.h>
#include <apps/bench_run.h>
#include <apps/commands.h>
#include <apps/plot.h>
#include <apps/report_text.h>
#include <projection/image/whole_file.h>

namespace tetralux::apps {

namespace {

constexpr int wrongPicture = 1;  // exit status

/// Everything that could keep the results from being written must show before the work, not after.
void checkOutputs(const BenchOptions& options) {
    for (const std::string& path : {options.csv, options.json})
        if (!path.empty()) projection::checkWritable(path);
    for (const std::string& path : options.plots) checkPlotPath(path);
}

void writeOutputs(const BenchOptions& options, const nlohmann::json& machine, const std::vector<BenchRow>& rows) {
    if (!options.csv.empty()) projection::writeWholeFile(options.csv, benchCsv(rows));
    if (!options.json.empty()) projection::writeWholeFile(options.json, jsonText(benchJson(machine, rows)));
    for (const std::string& path : options.plots) writePlot(benchPlot(rows), path);
}

std::string machineLine(const nlohmann::json& machine) {
    return fmt::format("{}, {} cores, {:.0f} GiB, {}, {}, tetralux {} by {}, load {:.1f}\n",
                       machine["cpu"].get<std::string>(), machine["cores"].get<int>(),
                       machine["memory_bytes"].get<double>() / 1073741824.0, machine["os"].get<std::string>(),
                       machine["kernel"].get<std::string>(), machine["tetralux"].get<std::string>(),
                       machine["compiler"].get<std::string>(), machine["load"][0].get<double>());
}

int bench(const BenchOptions& options) {
    checkOutputs(options);
    const BenchPlan plan = benchPlan(options);
    nlohmann::json machine = machineDescription();
    const bool telling = !options.quiet && ::isatty(STDERR_FILENO) == 1;
    const std::vector<BenchRow> rows = runBench(plan, [&](const std::string& step) {
        if (telling) fmt::print(stderr, "\r\x1b[K{}", step);
    });
    if (telling) fmt::print(stderr, "\r\x1b[K");
    machine["load_after"] = machineDescription()["load"];
    writeOutputs(options, machine, rows);
    if (!options.quiet) fmt::print("{}{}", machineLine(machine), benchTable(rows));
    if (!options.quick) return 0;
    const std::vector<std::string> wrong = wrongPictures(rows);
    for (const std::string& line : wrong) fmt::print(stderr, "tetralux: wrong picture: {}\n", line);
    return wrong.empty() ? 0 : wrongPicture;
}

}  // namespace

void addBenchCommand(CLI::App& program, Command& chosen) {
    const auto options = std::make_shared<BenchOptions>();
    CLI::App* command = program.add_subcommand("bench", "run time against error: a table, CSV, JSON and plots");
    addBenchOptions(*command, *options);
    command->callback([command, options, &chosen] {
        if (options->quick) makeQuick(*command, *options);
        chosen = [options] { return bench(*options); };
    });
}

}  // namespace tetralux::apps
