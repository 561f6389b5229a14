// SPDX-License-Identifier: Apache-2.0
/// \file
/// Names that people may have meant.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace tetralux::preint {

/// Letters and digits alone, small: what is left when spelling is forgiven.
std::string foldedName(std::string_view name);

/// Up to three of `known` that are nearest to `name`, by letters changed, left out, added or swapped (optimal string
/// alignment) or as its beginning; none where none is near.
std::vector<std::string> similarNames(std::string_view name, const std::vector<std::string>& known);

/// ` did you mean "a" or "b"?`, or nothing.
std::string didYouMean(std::string_view name, const std::vector<std::string>& known);

}  // namespace tetralux::preint
