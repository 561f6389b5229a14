// SPDX-License-Identifier: Apache-2.0
/// \file
/// The benchmark's rows as text for people, as CSV and JSON for programs, as plots.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include <apps/bench_row.h>
#include <apps/plot.h>

namespace tetralux::apps {

/// A block per subject; '*' marks the rows that no other beats in both time and error. Its last line sets our fastest
/// engine against VTK's fastest mapper, where both were measured.
std::string benchTable(const std::vector<BenchRow>& rows);

/// A header and a line per row. Several values in one column stand as "name=value;name=value".
std::string benchCsv(const std::vector<BenchRow>& rows);

/// {"machine": …, "rows": [{"scene", "tetrahedra", "size", "tf", "mode", "engine", …}]}
nlohmann::json benchJson(const nlohmann::json& machine, const std::vector<BenchRow>& rows);

/// A panel per subject, rmse over median time. The reference is the judge and is not shown.
Plot benchPlot(const std::vector<BenchRow>& rows);

}  // namespace tetralux::apps
