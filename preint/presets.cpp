// SPDX-License-Identifier: Apache-2.0
#include <preint/color_maps/color_maps.h>
#include <preint/transfer_function.h>

namespace tetralux::preint {

std::vector<std::string> presetNames() {
    return {"viridis",      "inferno",   "plasma",  "magma",      "cividis",       "turbo",
            "cool-to-warm", "grayscale", "rainbow", "black-body", "blue-to-yellow"};
}

std::vector<ExtinctionNode> suggestedExtinction() {
    return {{0.0, 0.5}, {0.15, 0.8}, {0.5, 4.0}, {1.0, 25.0}};
}

TransferFunction preset(const std::string& name) {
    ColorMap map = colorMap(name);
    TransferFunction function;
    function.color = std::move(map.nodes);
    function.categories = std::move(map.categories);
    function.extinction = suggestedExtinction();
    function.normalized = true;
    function.extinctionPerExtent = true;
    function.extinctionSuggested = true;
    return function;
}

}  // namespace tetralux::preint
