// SPDX-License-Identifier: Apache-2.0
/// \file
/// Measures engines of ours: time with a moving camera, error against the reference at the same cameras, memory.
#pragma once

#include <string>
#include <vector>

#include <glm/vec2.hpp>

#include <apps/bench_row.h>
#include <projection/core/engine.h>
#include <projection/core/scene.h>
#include <projection/image/image.h>

namespace tetralux::apps {

/// How often frames are drawn. A row that has used up `budgetSeconds` stops early, but draws one frame at least.
struct FramePlan {
    int frames = 5;  ///< timed ones, after one that is not
    int judged = 1;  ///< the first so many of them are compared with the reference
    double budgetSeconds = 20.0;
};

/// One engine with its settings, as a row names it.
struct EngineChoice {
    projection::EngineOptions options;
    int tableSize = 0;        ///< texels per scalar axis; 0: chosen by the engine
    int threads = 0;          ///< 0: all
    double tableError = 0.0;  ///< 0: the default
    projection::OrderMethod order = projection::OrderMethod::Auto;
    bool everyNode = false, skipInvisible = true, earlyTermination = true;  ///< as RenderSettings has them

    bool asksForTable() const { return tableSize > 0 || tableError > 0.0; }
    std::string name() const;     ///< "cpu", "gl:egl"
    std::string setting() const;  ///< "table 64, 1 thread"; empty for the defaults
};

/// The judge's pictures of one subject.
struct ReferenceImages {
    std::vector<projection::Image> images;  ///< of frames 0, 1, …
    BenchRow row;                           ///< what the judge itself took
};

/// The reference engine's pictures of the first `plan.judged` frames, and its own row.
ReferenceImages judge(const projection::Scene& scene, const BenchSubject& subject, const FramePlan& plan);

/// One row for each of `subjects`, which differ in size alone; `references` are theirs. The engine is made once; none
/// where a table's size is asked of an engine without table. Where it cannot be made or fails, the rows say why.
std::vector<BenchRow> measureEngine(const projection::Scene& scene, const EngineChoice& choice,
                                    const std::vector<BenchSubject>& subjects,
                                    const std::vector<ReferenceImages>& references, const FramePlan& plan);

/// Puts the largest of the differences between `image` and the reference of frame `frame` into the row.
void judgeFrame(BenchRow& row, const ReferenceImages& reference, std::size_t frame, const projection::Image& image);

}  // namespace tetralux::apps
