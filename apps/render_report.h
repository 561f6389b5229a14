// SPDX-License-Identifier: Apache-2.0
/// \file
/// What a run tells in --report.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <apps/render_options.h>
#include <apps/render_scene.h>

namespace tetralux::apps {

/// {"engine", "renderer", "cells": {"read", "tetrahedra", "drawn", "skipped": {reason: count}}, "ms": {"read",
/// "prepare", "frame": […], stage: […] …}, "pixels", "peak_memory_bytes", …}; with --preview also "preview":
/// {"promised_ms", "frame_ms", "kept", "size", "grid" (points along each edge of the coarse mesh, 0 for none)}. Counts
/// are those of the first frame, times are in milliseconds.
nlohmann::json renderReport(const RenderOptions& options, const SceneRenderer& renderer);

/// Whether --max-error is kept: the 95 % bound of the rmse, of the worst frame, is no more than that.
bool withinMaxError(const RenderOptions& options, const RenderRecord& record);

}  // namespace tetralux::apps
