// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace tetralux::mesher {

/// The command line of `tetralux mesh`.
struct Options {
    std::string input;   ///< file, or generated field ("bucky:32")
    std::string output;  ///< a .vtu file
    bool repair = false;
    bool points = false;     ///< take a surface's points alone, as a cloud
    double quality = 2.0;    ///< radius-edge ratio; 0: none
    double maxVolume = 0.0;  ///< mesh units cubed; 0: none
    bool keepSurface = false;
    std::string method = "cgal";          ///< for point clouds: "cgal" or "tetgen"
    std::vector<std::string> fields;      ///< --field
    std::uint64_t targetCells = 0;        ///< 0: as they come
    std::optional<double> maxFieldError;  ///< part of each field's range
    double surfaceTolerance = 0.0;  ///< part of the bounding box' diagonal that coarsening may move the surface by
    double timeLimit = 3600.0;      ///< seconds
    std::string report;             ///< JSON file
    bool quiet = false;
};

/// Reads the command line. Returns nothing when --help was asked for (and has been printed).
/// \throws std::runtime_error saying what is wrong with it.
std::optional<Options> parseCommandLine(int argumentCount, char** arguments);

}  // namespace tetralux::mesher
