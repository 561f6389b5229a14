// SPDX-License-Identifier: Apache-2.0
/// \file
/// A picture within a promised time: smaller, and of a coarser mesh if need be, as measured costs allow.
#pragma once

#include <memory>

#include <projection/core/engine.h>

namespace tetralux::projection {

struct Preview {
    Image image;                     ///< of the camera's size, enlarged from `width`×`height`
    double frameMilliseconds = 0.0;  ///< from the camera to `image`
    int width = 0, height = 0;       ///< pixels that were rendered
    int gridPoints = 0;              ///< points along each edge of the coarse mesh; 0: the mesh itself was drawn
    bool kept = false;               ///< whether the promise was kept; it is not where even the least takes longer
};

/// Draws previews of a scene. The cost of a frame is taken to be a + b·pixels, both measured on small pictures before
/// (they count as preparation): a is a matter of the mesh, and where it alone takes a third of the promised time,
/// coarser and coarser meshes (mesh::coarseMesh) are tried; the pixels follow from b. A frame that took longer after
/// all is drawn again with less.
class PreviewRenderer {
public:
    /// `engine` draws `scene` as it is and must outlive the renderer; `options` are those it was made with.
    PreviewRenderer(const Scene& scene, const EngineOptions& options, Engine& engine);

    /// \throws std::runtime_error as engines do, and unless promisedMilliseconds > 0.
    Preview render(const Camera& camera, double promisedMilliseconds);

private:
    struct Cost {
        double base, perPixel;  // milliseconds
    };
    Cost measure(const Camera& camera);
    Preview attemptOf(const Camera& view, const Camera& whole, double promisedMilliseconds);
    void coarsen(const Camera& camera, double promisedMilliseconds, Cost& cost);

    Scene scene_;
    EngineOptions options_;
    Engine* engine_;  // the one given, or `coarse_`
    std::unique_ptr<Engine> coarse_;
    int gridPoints_ = 0;
};

}  // namespace tetralux::projection
