// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include <glm/vec3.hpp>

#include <mesh/tet/surface_mesh.h>
#include <mesh/tet/tet_mesh.h>
#include <preint/preintegration_table.h>
#include <preint/transfer_function.h>
#include <projection/core/kept.h>
#include <projection/core/modes.h>
#include <projection/core/pixel_maps.h>
#include <shading/lights.h>
#include <shading/vertex_light.h>

namespace tetralux::projection {

/// How cells are put in order. Auto takes the cheapest method that is certain for the mesh; the others are for
/// measuring: Graph does without power keys (power_order.h), Centroid sorts by the distance of centroids, which is
/// wrong in some pixels: they are counted, not repaired.
enum class OrderMethod { Auto, Graph, Centroid };

struct RenderSettings {
    Mode mode = Mode::Standard;
    OrderMethod order = OrderMethod::Auto;
    int samples = 1;  ///< at least so many rays per pixel, whose colours are averaged (sampled_engine.h)
    shading::ShadingSettings shading;
    Classification classification = Classification::Preintegrated;  ///< of standard, scale-invariant and first-hit
    std::optional<AdaptiveSettings> adaptive;
    ContributionWeights contributions{};
    double largestExtinctionScale = 0.0;  ///< of the pixel maps that views will bring; 0: they bring none
    preint::TableOptions table;
    static constexpr int threadsOfCaller = -1;
    int threads = 0;  ///< 0: all; threadsOfCaller: those of the arena in which the engine is made and asked for frames
    /// The cpu engine walks along every node of the transfer function. Off: where there are many, it takes runs of
    /// nodes that a line meets within 1e-5 as one.
    bool everyNode = false;
    bool earlyTermination = true;  ///< off to measure what it saves: cells behind opaque pixels are drawn as well
    bool skipInvisible = true;     ///< off likewise: cells that the transfer function hides are drawn as well
};

/// What is drawn; engines keep what they derive from it from frame to frame.
struct Scene {
    std::shared_ptr<const mesh::ScalarMesh> mesh;
    preint::TransferFunction transferFunction;  ///< absolute (preint::resolved)
    RenderSettings settings;
    /// Clip planes, slices, opaque surfaces: asked in turn for every frame.
    std::vector<std::shared_ptr<const PixelMapSource>> mapSources = {};
    /// What keeps light from the volume besides it, where there are shadows: opaque surfaces.
    std::vector<std::shared_ptr<const mesh::SurfaceMesh>> shadowCasters = {};
    /// Kept for several engines (withVertexLight in light_frame.h); where there is none each makes its own.
    std::shared_ptr<const shading::VertexLight> vertexLight{};
    /// Both are nullptr where one engine draws one scene, and nothing is kept for another.
    std::shared_ptr<MeshMemo> meshMemo{};        ///< of this mesh's points and cells, whatever the field
    std::shared_ptr<FrameMemory> frameMemory{};  ///< of whoever draws one scene after the other
};

}  // namespace tetralux::projection
