// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <initializer_list>
#include <span>
#include <string>
#include <string_view>

namespace tetralux::mesh {

/// Whether `source` ends in one of the extensions (".vtu"), in upper or lower case.
bool hasExtension(const std::string& source, std::span<const char* const> extensions);
inline bool hasExtension(const std::string& source, std::initializer_list<const char*> extensions) {
    return hasExtension(source, std::span<const char* const>(extensions.begin(), extensions.size()));
}

/// \throws std::runtime_error naming `source` if it does not exist, is a directory, is empty or may not be read.
void checkReadable(const std::string& source);

/// \throws std::runtime_error as `checkReadable` does, or if the file begins with none of `beginnings`; `what` names
/// the format. Readers that take long over anything else are spared it.
void checkBeginning(const std::string& source, std::initializer_list<std::string_view> beginnings, const char* what);

}  // namespace tetralux::mesh
