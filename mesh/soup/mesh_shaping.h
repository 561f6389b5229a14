// SPDX-License-Identifier: Apache-2.0
/// \file
/// Parts of a mesh, and other shapes of it: blocks by name, thresholds, warping, scaling.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include <mesh/soup/read_options.h>

namespace tetralux::mesh {

/// Keeps the cells all of whose values lie from `low` to `high`, both included; cells without a value are left out.
struct Threshold {
    std::string field;  ///< as selectScalar takes names
    double low, high;
};

/// Moves every point by `factor` times its value of a vector field on points.
struct Warp {
    std::string field;
    double factor = 1.0;
};

struct MeshShaping {
    std::vector<std::string> blocks;        ///< these alone, by name or number; empty: all
    std::vector<std::string> hiddenBlocks;  ///< without these
    std::vector<Threshold> thresholds;
    std::optional<Warp> warp;
    std::optional<glm::dvec3> scale;  ///< factors along x, y and z, after the rest

    bool none() const { return blocks.empty() && hiddenBlocks.empty() && thresholds.empty() && !warp && !scale; }
};

/// Does all of it, in the order of its members, to the mesh of `result`, which is checked again: cells that warping
/// makes flat are left out and counted, those that it turns inside out are turned round. \throws std::runtime_error
/// naming field or block when there is none such, and when no cell is left.
void shapeMesh(ReadResult& result, const MeshShaping& shaping);

/// "name (number)" of every block of the mesh, for people.
std::vector<std::string> blockList(const ReadResult& result);

}  // namespace tetralux::mesh
