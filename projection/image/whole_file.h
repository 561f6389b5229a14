// SPDX-License-Identifier: Apache-2.0
/// \file
/// Output files that appear whole or not at all.
#pragma once

#include <string>
#include <string_view>

namespace tetralux::projection {

/// Writes `bytes` beside `path` and renames, so that no reader and no failure ever meets half a file. A symbolic link
/// to a file is followed. \throws std::runtime_error naming the path, what is wrong and what would mend it; nothing is
/// left behind then.
void writeWholeFile(const std::string& path, std::string_view bytes);

/// Finds out whether writeWholeFile could write `path`, by creating and removing the file beside it: permissions,
/// read-only file systems and missing folders all show. To be called before work starts whose result `path` shall hold.
/// \throws std::runtime_error as writeWholeFile
void checkWritable(const std::string& path);

}  // namespace tetralux::projection
