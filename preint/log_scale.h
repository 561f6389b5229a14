// SPDX-License-Identifier: Apache-2.0
/// \file
/// Nodes that are linear in the logarithm of the scalar, as nodes that are linear in the scalar: close enough together
/// to follow it to within 1/1024 of a colour channel, of opacity and of the largest extinction.
#pragma once

#include <functional>
#include <vector>

#include <preint/transfer_function.h>

namespace tetralux::preint {

/// `nodes` have logarithms in the place of scalars; `scalarOf` takes them back, for instance exp.
std::vector<ColorNode> fromLogarithms(const std::vector<ColorNode>& nodes,
                                      const std::function<double(double)>& scalarOf);
std::vector<OpacityNode> fromLogarithms(const std::vector<OpacityNode>& nodes,
                                        const std::function<double(double)>& scalarOf);
std::vector<ExtinctionNode> fromLogarithms(const std::vector<ExtinctionNode>& nodes,
                                           const std::function<double(double)>& scalarOf);

}  // namespace tetralux::preint
