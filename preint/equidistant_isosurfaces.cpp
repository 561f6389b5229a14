// SPDX-License-Identifier: Apache-2.0
#include <preint/equidistant_isosurfaces.h>

#include <algorithm>
#include <cmath>

namespace tetralux::preint {

std::vector<double> equidistantValues(int count, double low, double high) {
    std::vector<double> values;
    for (int i = 0; i < count; ++i) values.push_back(low + (i + 0.5) * ((high - low) / count));
    return values;
}

TransferFunction equidistantIsosurfaces(const TransferFunction& function, int count, double scalarMin,
                                        double scalarMax) {
    TransferFunction result = function;
    const double step = (scalarMax - scalarMin) / count;
    for (const double value : equidistantValues(count, scalarMin, scalarMax)) {
        const double opacity = -std::expm1(-function.extinctionAt(value) * step);
        if (opacity > 0) result.isosurfaces.push_back({value, opacity, function.colorAt(value)});
    }
    std::stable_sort(result.isosurfaces.begin(), result.isosurfaces.end(),
                     [](const Isosurface& a, const Isosurface& b) { return a.value < b.value; });
    result.extinction = {{scalarMin, 0.0}};
    return result;
}

}  // namespace tetralux::preint
