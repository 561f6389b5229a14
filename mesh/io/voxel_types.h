// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <string_view>

namespace tetralux::mesh {

/// A type of the values in volume files.
struct VoxelType {
    const char* names;  ///< as files have them, between bars
    std::size_t size;   ///< bytes
    double (*at)(const char* bytes, bool bigEndian);

    bool isCalled(std::string_view name) const;
};

/// All of them; of those of one size the most usual comes first.
std::span<const VoxelType> voxelTypes();

}  // namespace tetralux::mesh
