// SPDX-License-Identifier: Apache-2.0
/// \file
/// One line of the benchmark: what was drawn by whom, how long it took and how far it is from the reference.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include <projection/image/image.h>

namespace tetralux::apps {

/// What a row's picture shows; rows of equal subject can be compared with each other.
struct BenchSubject {
    std::string scene;  ///< "bucky:32" or a file
    std::uint64_t tetrahedra = 0;
    int width = 0, height = 0;     ///< pixels
    std::string transferFunction;  ///< a name of benchTransferFunctionNames()
    std::string mode;              ///< as `--mode` takes it

    auto operator<=>(const BenchSubject&) const = default;
};

/// Times are wall times in milliseconds; errors are differences of linear premultiplied RGBA to the reference engine's
/// image.
struct BenchRow {
    BenchSubject subject;
    std::string engine;    ///< "cpu", "gl:egl", "vtk:projected"
    std::string setting;   ///< what differs from the defaults: "table 64", "1 thread"; mostly empty
    std::string renderer;  ///< what did the work
    std::string failure;   ///< one line; empty when there are figures

    std::vector<double> frameMilliseconds;  ///< camera moved before each, after a warm-up
    /// Of all threads together, frame by frame: what is left to compare when others keep the machine busy.
    std::vector<double> processorMilliseconds;
    std::map<std::string, double> stageMilliseconds;    ///< medians over the frames
    std::map<std::string, double> prepareMilliseconds;  ///< once for all frames, by part
    double prepareTotalMilliseconds = 0.0;

    bool judged = false;
    projection::ImageDifference error;  ///< over all judged frames; the largest of each

    std::uint64_t cellsDrawn = 0, cellsSorted = 0, fragments = 0;  ///< of the first frame
    std::map<std::string, std::uint64_t> cellsSkipped;             ///< by reason, first frame
    std::uint64_t tileEntries = 0, tileEntriesSaved = 0;           ///< as FrameReport has them
    std::string orderMethod;
    std::string dataPath;              ///< gl: "stream", "resident" or "tiles"
    std::uint64_t bytesUploaded = 0;   ///< gl: for cells and order, first frame
    std::uint64_t pixelsRepaired = 0;  ///< over all frames

    int tableSize = 0, tableSlices = 0;  ///< texels per scalar axis and zone, length slices; 0: no table
    double tableError = 0.0, tableMilliseconds = 0.0;

    std::uint64_t peakMemoryBytes = 0;      ///< of the process
    std::uint64_t memoryOverMeshBytes = 0;  ///< the same less what the process held before the engine was made
    bool onFront = false;                   ///< no row of this subject is both faster and more accurate

    double medianMilliseconds() const;  ///< 0 without frames
    double leastMilliseconds() const;   ///< of the least disturbed frame; 0 without frames
    double medianProcessorMilliseconds() const;
    double tetrahedraPerSecond() const;
    double fragmentsPerSecond() const;
    double bytesPerTetrahedron() const;  ///< of memoryOverMeshBytes
};

/// Sets `onFront` for the rows that nobody beats in both median time and rmse, subject by subject. Rows without figures
/// and the reference itself, which has no error to show, stay off it.
void markFronts(std::vector<BenchRow>& rows);

}  // namespace tetralux::apps
