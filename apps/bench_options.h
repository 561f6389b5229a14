// SPDX-License-Identifier: Apache-2.0
/// \file
/// What `tetralux bench` is asked for.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <glm/vec2.hpp>

#include <apps/bench_run.h>
#include <projection/core/scene.h>

namespace CLI {
class App;
}

namespace tetralux::apps {

struct BenchOptions {
    std::vector<std::string> scenes{"bucky"};
    std::vector<std::uint64_t> cells{150'000, 1'250'000};
    std::vector<glm::ivec2> sizes{{512, 512}};
    std::vector<std::string> transferFunctions{"smooth", "peaks", "opaque", "constant"};
    std::vector<projection::Mode> modes{projection::Mode::Standard};
    std::vector<std::string> engines;  ///< names as in rows; empty: all there are
    std::vector<int> tableSizes{0};
    std::vector<std::string> glPaths{"auto"};
    std::vector<int> threads{0};
    std::vector<double> tableErrors{0.0};
    std::vector<projection::OrderMethod> orders{projection::OrderMethod::Auto};
    std::vector<bool> silhouettes{false};
    std::vector<std::optional<projection::AdaptiveSettings::Unit>> adaptive{std::nullopt};
    std::vector<int> samples{1};
    std::vector<bool> everyNode{false}, skipInvisible{true}, earlyTermination{true};
    FramePlan plan;
    std::string csv, json;
    std::vector<std::string> plots;
    bool quick = false;
    bool quiet = false;
};

/// Adds bench's options to `command`; parsing fills `options`.
void addBenchOptions(CLI::App& command, BenchOptions& options);

/// What --quick sets where the command line says nothing else: a tiny scene, all frames judged.
void makeQuick(const CLI::App& command, BenchOptions& options);

/// What the options ask for. \throws std::runtime_error naming the option and listing the names there are.
BenchPlan benchPlan(const BenchOptions& options);

}  // namespace tetralux::apps
