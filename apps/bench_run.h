// SPDX-License-Identifier: Apache-2.0
/// \file
/// The benchmark itself: every scene, size, transfer function and mode, drawn by every engine, judged by the reference.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <glm/vec2.hpp>

#include <apps/bench_engine.h>
#include <apps/bench_row.h>
#include <projection/core/scene.h>

namespace tetralux::apps {

struct NamedMode {
    std::string name;
    projection::Mode mode = projection::Mode::Standard;
    bool silhouette = false;
    std::optional<projection::AdaptiveSettings> adaptive = {};
    int samples = 1;  ///< per pixel
};

/// The engines asked for, with every table size and thread count asked for.
struct BenchEngines {
    std::vector<EngineChoice> choices;
    std::vector<std::string> vtkMappers;  ///< drawn by `vtkProgram`, in the standard mode only
    std::string vtkProgram;
    bool reference = false;  ///< the judge's own rows are wanted
};

struct BenchPlan {
    std::vector<std::string> sources;  ///< as `tetralux render` takes them
    std::vector<glm::ivec2> sizes;     ///< pixels
    std::vector<std::string> transferFunctions;
    std::vector<NamedMode> modes;
    BenchEngines engines;
    FramePlan frames;
};

/// One row per subject and engine, subject by subject; fronts are marked. `tell` gets a line before each step, for
/// people who wait. \throws std::runtime_error for a mesh that cannot be read or an unknown transfer function; what an
/// engine cannot do is told in its rows.
std::vector<BenchRow> runBench(const BenchPlan& plan, const std::function<void(const std::string&)>& tell);

/// The largest rmse that a picture of ours may have: 1e-4, with isosurfaces 2e-3 (a silhouette of one moves by a
/// rounding, and whole pixels with it).
double rmseBound(const BenchSubject& subject);

/// A line for each of our rows whose picture is wrong, and one when there is no picture at all. Engines that this
/// machine lacks are no fault.
std::vector<std::string> wrongPictures(const std::vector<BenchRow>& rows);

}  // namespace tetralux::apps
