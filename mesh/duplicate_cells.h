// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include <mesh/equal_items.h>
#include <mesh/tet_mesh.h>

namespace tetralux::mesh {

/// Finds cells with the same four points. Noting them can be part of another pass.
class DuplicateSearch {
public:
    DuplicateSearch(std::size_t cellCount, std::size_t pointCount);

    /// For cell `i` at most once, from any thread; its points must be below the `pointCount` given and stay as they
    /// are.
    void note(const std::vector<Tetrahedron>& cells, std::uint32_t i);

    /// The cells noted that have the same points as one before them, in ascending order.
    std::vector<std::uint32_t> find(const std::vector<Tetrahedron>& cells);

private:
    EqualItems items_;
    std::uint64_t slotsPerPoint_;
};

}  // namespace tetralux::mesh
