// SPDX-License-Identifier: Apache-2.0
/// \file
/// Generated meshes whose scalar is known as a function: for tests, benchmarks and demonstrations.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <mesh/tet/tet_mesh.h>

namespace tetralux::mesh {

/// A scalar field given by formula on a cube; `value` in scalar units, `gradient` in scalar units per mesh unit.
struct ProceduralField {
    std::string name;       ///< "bucky", "coulomb", "marschner-lobb", "hydrogen"
    std::string fieldName;  ///< name of the point field: "density", …
    BoundingBox domain;     ///< mesh units
    std::function<double(const glm::dvec3&)> value;
    std::function<glm::dvec3(const glm::dvec3&)> gradient;
};

/// The field of that name for a grid of n points per edge (bucky is normalized by its largest mesh value).
/// \throws std::runtime_error listing the names there are.
ProceduralField proceduralField(const std::string& name, int n);

/// n×n×n points over the field's domain, every cube split into 5 tetrahedra with alternating parity:
/// (n − 1)³·5 positively oriented cells. \throws std::runtime_error unless 2 ≤ n ≤ 1000.
TetMesh sampleOnGrid(const ProceduralField& field, int n);

/// Splits "bucky:32" into name and size; nothing if `source` is not of that form with a known name.
struct ProceduralSource {
    std::string name;
    int n;
};
std::optional<ProceduralSource> parseProceduralSource(const std::string& source);

std::vector<std::string> proceduralFieldNames();

}  // namespace tetralux::mesh
