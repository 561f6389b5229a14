// SPDX-License-Identifier: Apache-2.0
/// \file
/// VTK XML files as VTK's readers understand them: one piece each, because they take the arrays of further pieces by
/// their places and not by their names, no larger than it, and numbers as C writes them.
#pragma once

#include <string>
#include <vector>

namespace tetralux::mesh {

struct VtkXmlText {
    std::string kind;                ///< "UnstructuredGrid", as the file says
    std::vector<std::string> files;  ///< what to read in place of the file, one by one; empty if it can be read itself
};

/// \throws std::runtime_error as `withPlainNumbers` does.
VtkXmlText plainVtkXml(const std::string& path);

}  // namespace tetralux::mesh
