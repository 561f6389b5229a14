// SPDX-License-Identifier: Apache-2.0
/// \file
/// Which scalars a transfer function shows.
#pragma once

#include <vector>

#include <glm/vec2.hpp>

#include <preint/exact_integral.h>
#include <preint/transfer_function.h>

namespace tetralux::projection {

/// The open intervals of scalars (low, high) with extinction, ascending, disjoint; −∞ and ∞ where an outer node has extinction. A low end at
/// which the extinction jumps up holds itself (the value there is that from above): it is moved down by 1e-7 of the nodes' range.
std::vector<glm::dvec2> extinctionSupport(const preint::TransferFunction& function);

/// Whether segments with scalars within [low, high] can have opacity.
bool rangeShows(const preint::TransferFunction& function, const std::vector<glm::dvec2>& support, double low, double high,
                preint::Integral integral);

}  // namespace tetralux::projection
