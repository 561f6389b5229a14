// SPDX-License-Identifier: Apache-2.0
/// \file
/// Transfer functions put together of the usual words, as pictures in PyVista and ParaView are.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <preint/transfer_function.h>

namespace tetralux::preint {

struct FunctionWords {
    std::string opacity;            ///< a word of opacity_words.h; empty: as it is
    std::vector<double> opacities;  ///< in its place: α at equal distances over the range
    std::optional<double>
        unitDistance;           ///< over which α counts, mesh units (or of the scalar); nothing: 1/50 of the diagonal
    double opacityScale = 1.0;  ///< extinction, and the opacity of isosurfaces, times this
    std::optional<glm::dvec2> range;  ///< scalars over which the function is stretched; nothing: as it is
    bool logScale = false;            ///< over the logarithm of the scalar
};

/// `function` with what `words` say of it. \throws std::runtime_error for words that there are not, opacities beyond
/// [0, 1], scales and distances that are not above 0, a range whose ends are not finite or ascending, a unit distance
/// of a function that has extinction.
TransferFunction withWords(TransferFunction function, const FunctionWords& words);

}  // namespace tetralux::preint
