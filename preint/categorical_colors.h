// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include <preint/transfer_function.h>

namespace tetralux::preint {

/// Colours in steps: the i-th of the `values` (ascending) has the i-th of function.categories, over again where there
/// are more values than colours, from halfway to the value before it to halfway to the next. Where there are no values,
/// the range is divided into as many equal parts as there are colours.
std::vector<ColorNode> categoricalColors(const std::vector<glm::dvec3>& categories, const std::vector<double>& values,
                                         double low, double high);

}  // namespace tetralux::preint
