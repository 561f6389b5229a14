// SPDX-License-Identifier: Apache-2.0
/// \file
/// An engine turns a scene and a camera into an image. To add one: a file that derives from Engine, and one line in
/// frame/engine_registry.cpp.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <glm/vec2.hpp>

#include <projection/core/camera.h>
#include <projection/core/pixel_maps.h>
#include <projection/core/scene.h>
#include <projection/image/image.h>

namespace tetralux::projection {

/// What one frame did, for reports and benchmarks.
struct FrameReport {
    std::uint64_t cellsDrawn = 0;
    std::map<std::string, std::uint64_t> cellsSkipped;  ///< by reason
    std::map<std::string, double> stageMilliseconds;    ///< wall time by stage: "sort", "setup", "draw", …
    double frameMilliseconds = 0.0;                     ///< from the new camera to the float image in memory
    std::uint64_t fragments = 0;                        ///< cell–pixel segments, where the engine counts them
    /// Entries of tile lists, and how many of them were never set up since their tile was opaque.
    std::uint64_t tileEntries = 0, tileEntriesSaved = 0;
    std::uint64_t tilesRetired = 0;  ///< tiles that were opaque before their cells were drawn
    std::string orderMethod;         ///< how visibility order was found; "none" when not needed
    std::uint64_t cellsSorted = 0;
    std::string incrementalSort =
        "none";                      ///< "sorted", "kept" or "repaired" of the last frame's; "none" when not needed
    std::uint64_t failingFaces = 0;  ///< inner faces that fail the certificate of power order, of a convex mesh
    std::uint64_t orderCycles = 0;   ///< cells left in cycles of the visibility relation
    /// Pixels (y·width + x, ascending) that the engine could not order with certainty; makeEngine's engines have them
    /// composed exactly afterwards and count them as repaired.
    std::vector<std::uint32_t> uncertainPixels;
    /// Where samples stand beside the centres (pixels), of engines in which floats say on which side of a face they run
    /// (edge_on_faces.h); none where double does.
    std::optional<glm::dvec2> floatSamples;
    std::uint64_t pixelsRepaired = 0;  ///< composed by the reference: those that the engine cannot vouch for
    std::map<std::string, std::uint64_t> repairedBecause;  ///< how many of them by reason, the first that was found
    /// Uncertain pixels that were not repaired: 0 but for OrderMethod::Centroid. cpu tells those in which it sees cells
    /// out of order, gl those in which two that follow one another may be, which are more.
    std::uint64_t pixelsWrong = 0;
    std::string dataPath;  ///< gl: "stream", "resident" or "tiles" (gl_path.h), and why
    std::string dataPathReason;
    std::uint64_t bytesUploaded = 0;        ///< gl: what the frame sent to the renderer for its cells and their order
    int drawnWidth = 0, drawnHeight = 0;    ///< pixels before the picture was enlarged, where a budget made it coarser
    std::shared_ptr<const PixelMaps> maps;  ///< what the frame was drawn with, where the scene has any
};

class Engine {
public:
    virtual ~Engine() = default;
    virtual Image render(const View& view, FrameReport& report) = 0;
    virtual std::string name() const = 0;      ///< "reference", "gl", …
    virtual std::string renderer() const = 0;  ///< what does the work: GL_RENDERER, or the instruction set
    /// What was made once for all frames: "adjacency", "table", …, in milliseconds.
    virtual std::map<std::string, double> prepareMilliseconds() const { return {}; }
    /// The table that look-ups use; nullptr when the engine has none.
    virtual const preint::PreintegrationTable* table() const { return nullptr; }
    virtual double wantedTableError() const { return 0.0; }  ///< what table() was asked for: rough functions miss it
    virtual bool walksNodes() const { return false; }  ///< along the transfer function's nodes then, in table()'s stead
};

struct EngineOptions {
    std::string engine = "auto";   ///< a registered name or "auto"
    std::string context = "auto";  ///< "auto", "egl", "osmesa": only GL engines read it
    std::string glPath = "auto";   ///< "auto" or another of glPathNames() (gl_path.h): likewise
};

}  // namespace tetralux::projection
