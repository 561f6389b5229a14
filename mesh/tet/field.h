// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace tetralux::mesh {

/// Where the values of a field live.
enum class Association { Point, Cell };

/// A named array of values on points or cells, as the file had it.
struct Field {
    std::string name;
    Association association = Association::Point;
    int components = 1;          ///< values per point or cell; 3 for a vector
    std::vector<double> values;  ///< components × (points or cells), components fastest
    bool bookkeeping = false;    ///< numbers of points, cells or blocks: shown only when asked for by name
    /// As the file calls them, "xx"; empty, or one for each component.
    std::vector<std::string> componentNames = {};
};

}  // namespace tetralux::mesh
