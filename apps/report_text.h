// SPDX-License-Identifier: Apache-2.0
/// \file
/// What subcommands tell about a mesh's defects, for people and for machines.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include <mesh/tet/mesh_report.h>

namespace tetralux::apps {

/// One line each: "12 flat cells (the first: 3, 8, 9)".
std::vector<std::string> defectLines(const mesh::MeshReport& report);

/// {"flat cell": {"count": 12, "first": [3, 8, 9]}, …}
nlohmann::json defectsJson(const mesh::MeshReport& report);

/// Text for a file; names that are no valid UTF-8 are made so.
std::string jsonText(const nlohmann::json& value);

}  // namespace tetralux::apps
