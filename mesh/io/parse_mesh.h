// SPDX-License-Identifier: Apache-2.0
/// \file
/// The formats that we parse ourselves, from their bytes: what the readers call and what the fuzzers feed. Each throws
/// a std::runtime_error that names `source`, what is wrong and what would mend it, and never trusts a number in the
/// bytes.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include <mesh/soup/cell_soup.h>

namespace tetralux::mesh {

/// Gmsh MSH 1.0, 2.x and 4.1, ascii and binary, with $NodeData and $ElementData at the step nearest to `time`.
CellSoup parseGmsh(std::string_view bytes, const std::string& source, std::optional<double> time);

/// MEDIT .mesh text, versions 1 to 4.
CellSoup parseMeditText(std::string_view bytes, const std::string& source);
/// MEDIT .meshb, either byte order, versions 1 to 4.
CellSoup parseMeditBinary(std::string_view bytes, const std::string& source);
/// Adds the solutions of a .sol text at the vertices of `soup` as point fields "solution", or "solution 1", … for
/// several.
void parseMeditSolution(std::string_view bytes, const std::string& source, CellSoup& soup);

/// NRRD image volumes with their places in space: raw, gzip, ascii and hex, either byte order. The values stand behind
/// the header, or are what `readData(file)` returns of the file that the header names.
CellSoup parseNrrd(std::string_view bytes, const std::string& source,
                   const std::function<std::string(const std::string& file)>& readData);

/// TetGen .node and .ele; attributes become fields "attribute" or "attribute 1", …, regions the cell field "region".
CellSoup parseTetgen(std::string_view nodes, const std::string& nodeSource, std::string_view elements,
                     const std::string& elementSource);

}  // namespace tetralux::mesh
