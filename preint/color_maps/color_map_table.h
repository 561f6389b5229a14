// SPDX-License-Identifier: Apache-2.0
/// \file
/// The colour maps of matplotlib and ParaView as they are stored: text that make_tables.py writes and color_maps.cpp
/// reads.
#pragma once

#include <vector>

namespace tetralux::preint {

/// The space in which a map's nodes are interpolated; a categorical one has colours without places.
enum class MapKind { Rgb, Lab, Hsv, Diverging, Categorical };

struct ColorMapText {
    const char* name;  ///< as its makers write it
    MapKind kind;
    const char*
        nodes;  ///< hexadecimal, without spaces: place, red, green, blue (categorical: no place), four digits each
};

const std::vector<ColorMapText>& matplotlibMaps();
const std::vector<ColorMapText>& paraViewMaps();

}  // namespace tetralux::preint
