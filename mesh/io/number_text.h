// SPDX-License-Identifier: Apache-2.0
/// \file
/// Numbers as programs write them: of C, and of Fortran, whose exponents may have a D ("1.0D+00") or, when they need
/// three digits, no letter at all ("1.234-101").
#pragma once

#include <string>
#include <string_view>

namespace tetralux::mesh {

enum class NumberText {
    Good,
    Beyond,  ///< larger than any double: "1e400"
    None,    ///< no number: "***", as Fortran writes what its format has no room for
};

/// The number that all of `word` is. Smaller ones than any double are 0. NaN and infinity have several spellings.
NumberText parseNumber(std::string_view word, double& value);

/// What is to be said of a `word` that `parseNumber` did not take, and what would mend it, in two parts.
std::string complaintOf(std::string_view word, NumberText kind, std::string_view what);
const char* remedyFor(std::string_view word, NumberText kind);

/// A word of unknown content as it can stand in one line of error text.
std::string shownWord(std::string_view word);

}  // namespace tetralux::mesh
