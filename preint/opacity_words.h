// SPDX-License-Identifier: Apache-2.0
/// \file
/// Opacity over a field's range by the words that PyVista has for it, as the curves that its tables of 256 steps are
/// made of.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <preint/transfer_function.h>

namespace tetralux::preint {

/// linear: α = f, the fraction of the range; geom: α = (1e-6/255)^(1 − f); sigmoid_N: α = 1/(1 + exp(−N (2 f − 1))), N
/// from 1 to 20, sigmoid is sigmoid_10; foreground: 0 in the range's first 256th, else 1; opaque: 1, and transparent:
/// 0. "_r" at the end reverses. Nodes over fractions, between which straight lines keep within 1/1024 of the curve.
/// \throws std::runtime_error for other words, naming those nearest.
std::vector<OpacityNode> opacityOfWord(std::string_view word);

std::vector<std::string> opacityWords();  ///< of them, for help

/// Values at equal distances over the range, as PyVista takes a list. \throws std::runtime_error unless there is one at
/// least and all are from 0 to 1.
std::vector<OpacityNode> opacityOfValues(const std::vector<double>& values);

/// Extinction times the unit distance, −ln(1 − α), at most `most`, of `nodes` between which α is linear: nodes between
/// which it is the extinction that is linear, to within 1/1024 of α.
std::vector<ExtinctionNode> opticalDepths(const std::vector<OpacityNode>& nodes, double most);

}  // namespace tetralux::preint
