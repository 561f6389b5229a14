// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <initializer_list>
#include <string>

namespace tetralux::mesh {

/// Whether `source` ends in one of the extensions (".vtu"), in upper or lower case.
bool hasExtension(const std::string& source, std::initializer_list<const char*> extensions);

/// \throws std::runtime_error naming `source` if it does not exist, is a directory, is empty or may not be read.
void checkReadable(const std::string& source);

}  // namespace tetralux::mesh
