// SPDX-License-Identifier: Apache-2.0
/// \file
/// Edits of a transfer function in absolute units, node by node.
#pragma once

#include <cstddef>
#include <string>

#include <apps/view/option_words.h>
#include <preint/transfer_function.h>

namespace tetralux::apps::view {

/// JSON in one line that is read back to the bit; scalars as they are, extinction per mesh unit.
std::string functionText(const preint::TransferFunction& function);

/// `words` with this function in place of all that they said of colour and opacity.
void setFunction(OptionWords& words, const preint::TransferFunction& function);

// Each keeps the nodes in ascending order. \throws std::runtime_error for a node that there is not, and for numbers
// that a node cannot have.

/// \returns the number of the new node.
std::size_t addNode(preint::TransferFunction& function, double scalar, double extinction);
/// Between its neighbours, which it does not pass.
void moveNode(preint::TransferFunction& function, std::size_t node, double scalar, double extinction);
void removeNode(preint::TransferFunction& function, std::size_t node);  ///< the last one stays
/// The colour there: of the node at this scalar, or of a new one.
void setColor(preint::TransferFunction& function, double scalar, const glm::dvec3& color);
void removeColor(preint::TransferFunction& function, std::size_t node);  ///< the last one stays
void addIsosurface(preint::TransferFunction& function, const preint::Isosurface& surface);
void removeIsosurface(preint::TransferFunction& function, std::size_t number);
void scaleExtinction(preint::TransferFunction& function, double factor);

}  // namespace tetralux::apps::view
