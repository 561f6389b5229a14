// SPDX-License-Identifier: Apache-2.0
/// \file
/// What the stages of the tile engine hand each other.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <mesh/tet/tet_mesh.h>
#include <projection/cells/camera_points.h>
#include <projection/cells/cell_constants.h>
#include <projection/cells/cell_setup.h>
#include <projection/core/camera.h>
#include <projection/core/scene.h>
#include <projection/core/transfer_support.h>
#include <projection/cpu/cpu_transfer.h>
#include <projection/image/image.h>
#include <projection/light/light_frame.h>

namespace tetralux::projection {

/// Pixels along a tile's side.
inline constexpr int cpuTileSize = 32;

/// A cell in a tile's list. Ascending keys are front to back.
struct TileEntry {
    std::uint32_t key;
    mesh::CellIndex cell;
};

/// What the picture asks of a tile.
enum class TileKind {
    Composite,   ///< colour and transmittance, front to back
    Absorption,  ///< optical depth only: all that is seen has one colour
    Shaded,      ///< composite with silhouettes or light
    FirstHit,
    // by drawClippedTile only
    Mip,
    Minimum,
    Average,
    Additive,  ///< light of all segments, none hidden
    Depth      ///< where along the ray something is first seen
};

/// Pixel maps (pixel_maps.h) in the terms of tiles, width·height each.
struct TileLimits {
    std::vector<float> nearest, farthest;      ///< as inverse depth along rays: segments lie between
    std::vector<float> layerEnd;               ///< likewise: where the layer of a cut ends; empty: none
    std::vector<float> scale;                  ///< of extinction; empty: 1
    std::vector<std::array<float, 3>> normal;  ///< of that cut, as (right, down, forward)
};

/// How segments of TileKind::Shaded are shaded.
enum class ShadingVariant {
    General,      ///< anything (cpu_shading.h)
    Silhouettes,  ///< silhouettes alone; this and the next by cpu_variant.h
    Lit,          ///< plain lights, with silhouettes or without
    LocalLights   ///< the same with lights at places, at the eye or of colour, and Blinn and Phong's highlights
};

/// A light as the quick variants need it.
struct QuickLight {
    int kind = 0;         ///< FrameLight's
    float place[3] = {};  ///< towards it, or where it is (light_frame.h): (right, down, forward)
    float color[3] = {1, 1, 1}, specular[3] = {1, 1, 1};  ///< of diffuse and of specular light
    bool fades = false;                                   ///< with the distance: FrameLight's fade
    float fade[3] = {1, 0, 0};
};

/// What the quick variants need of a frame.
struct QuickVariant {
    static constexpr std::size_t mostLights = 8;
    ShadingVariant variant = ShadingVariant::General;
    bool silhouettes = false, transmission = false;
    std::size_t lights = 0;
    QuickLight localLights[mostLights];
    float ambient[3] = {}, exponent = 0;
    unsigned wholeExponent = 0;  ///< the exponent, when it is a whole number that squaring makes; else 0
    float leastCosine = 0;       ///< below it a lobe is less than 1e-8
    // of ShadingVariant::LocalLights
    bool orthographic = false;
    bool halfway = false;  ///< lobes about the half-way vector
    bool places = false;   ///< some local light asks where the segments are
    float diffuse = 1, specular = 1, diffuseThrough = 1, specularThrough = 1;
};

/// The same for all tiles of one frame.
struct TileFrame {
    const CameraFrame* camera;
    const CameraPoint* points;
    const mesh::Tetrahedron* cells;
    const float* scalars;        ///< scene units, per point or per cell
    const double* fieldScalars;  ///< the same in the field's own units
    double scalarScale;          ///< the field's units per scene unit
    bool cellData;
    const CpuTransfer* transfer;
    const ScalarColors* scalarColors;  ///< of extreme and mean scalars
    TileKind kind;
    bool scaleInvariant;
    bool ordered;  ///< entries come front to back, so a pixel where they do not is uncertain
    bool orthographic;
    int width, height;
    glm::dvec2 centre;           ///< sampleCentre of the camera
    double pixel;                ///< size of a pixel at depth 1 (orthographic: in scene lengths)
    double rowLean, rowStretch;  ///< of the camera's
    double depthReference;       ///< scene lengths: inverse depth along rays is measured from this depth
    float orderTolerance;        ///< of inverse depth
    const shading::ShadingSettings* shading;
    std::vector<std::array<float, 3>> lights;  ///< towards each, as (right, down, forward)
    QuickVariant variant;
    // light in full (cpu_light.h): anything that ShadingSettings::plain() does not hold for
    bool lightInFull;
    bool attributes;  ///< whether anything reads those of the vertices
    bool smoothSilhouettes;
    LightModelFloats lightModel;
    std::vector<FrameLight> fullLights;
    std::array<glm::vec3, 3> axes;  ///< right, down, forward in world space
    const shading::VertexLight* vertexLight;
    bool earlyTermination;
    const TileLimits* limits = nullptr;
    Classification classification = Classification::Preintegrated;
    glm::vec3 constantColor{0};  ///< Absorption: of all that is seen
    bool emissionOnly = false;   ///< Additive: alpha stays 0
    ContributionWeights contributions{};
    double greyOfReference = 0,
           greyPerDistance =
               0;  ///< grey of TileKind::Depth at the distance depthReference, and per scene length beyond
};

struct TileResult {
    std::uint64_t fragments = 0;
    std::uint64_t cellsSetUp = 0;
    bool retired = false;  ///< opaque before its list ended
    std::vector<std::uint32_t> uncertainPixels;
};

/// Draws the tile whose first pixel is (x0, y0) into `image`: the most usual pictures, without limits.
void drawTile(const TileFrame& frame, int x0, int y0, std::span<const TileEntry> entries, Image& image,
              TileResult& result);

/// The same with all kinds, within `frame.limits` and with `frame.classification`; not as fast.
void drawClippedTile(const TileFrame& frame, int x0, int y0, std::span<const TileEntry> entries, Image& image,
                     TileResult& result);

/// Name of the instruction set that drawTile uses.
const char* tileInstructionSet();

}  // namespace tetralux::projection
