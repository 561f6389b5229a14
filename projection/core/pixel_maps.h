// SPDX-License-Identifier: Apache-2.0
/// \file
/// What depends on the pixel: where its ray may see the volume, how opaque the volume is there, and what lies behind.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <projection/core/camera.h>
#include <projection/core/frame_control.h>
#include <projection/image/image.h>

namespace tetralux::projection {

/// Something that lets part of what is behind it through: a slice with opacity.
struct TranslucentFragment {
    std::uint32_t pixel;  ///< y·width + x
    double distance;      ///< along the unit ray, mesh units
    glm::vec4 color;      ///< premultiplied RGBA

    /// By pixel, then from the eye on.
    bool operator<(const TranslucentFragment& other) const {
        return pixel != other.pixel ? pixel < other.pixel : distance < other.distance;
    }
};

/// Each vector but `translucent` is empty (nothing) or has width·height elements, row-major, row 0 at the top. Engines
/// honour all but `behind`, which composes the finished volume (view_maps.h), and `translucent`, between which it is
/// drawn part by part (translucent_slices.h); the reference honours those by itself.
struct PixelMaps {
    /// Distance along the unit ray (mesh units) before which nothing of the volume is seen.
    std::vector<double> nearest;
    std::vector<double> farthest;        ///< distance behind which nothing of the volume is seen (an opaque surface)
    std::vector<double> cutLayerEnd;     ///< distance up to which the ray runs within the layer of a cut, whose normal
                                         ///< is lit there in the place of the field's; 0: no layer
    std::vector<glm::vec3> cutNormal;    ///< of that layer: world space, unit, towards the eye's side
    std::vector<float> extinctionScale;  ///< factor of extinction and of the depth of isosurfaces, ≥ 0
    std::vector<glm::vec4> behind;       ///< premultiplied RGBA put under the volume (slices, opaque surfaces)
    std::vector<TranslucentFragment> translucent;  ///< within the volume, between nearest and farthest; ascending

    bool empty() const {
        return nearest.empty() && farthest.empty() && extinctionScale.empty() && behind.empty() && translucent.empty();
    }
    /// Whether engines have to look at the maps.
    bool changeVolume() const {
        return !nearest.empty() || !farthest.empty() || !extinctionScale.empty() || !translucent.empty();
    }
};

/// What an engine is asked for; made implicitly of a camera alone.
struct View {
    Camera camera;
    const PixelMaps* maps = nullptr;        ///< nullptr: no limits; else of the camera's size
    const FrameControl* control = nullptr;  ///< nullptr: nobody stops the frame

    View(const Camera& c, const PixelMaps* m = nullptr,
         const FrameControl* wait = nullptr)  // NOLINT: implicit on purpose
        : camera(c), maps(m), control(wait) {}
};

/// Adds to the maps of every frame: clip planes, opaque surfaces. Those of a scene are asked in turn.
class PixelMapSource {
public:
    virtual ~PixelMapSource() = default;
    /// Narrows `maps`: nearest may only grow, farthest only shrink. \throws std::runtime_error for what it cannot do.
    virtual void apply(const Camera& camera, PixelMaps& maps) const = 0;
};

/// Where a ray comes into a region of which the volume is cut out.
struct Cut {
    double distance = 0.0;  ///< along the unit ray, mesh units; less than 0 where the eye stands within
    double layerEnd = 0.0;  ///< PixelMaps::cutLayerEnd of this cut
    glm::vec3 normal{0};    ///< PixelMaps::cutNormal of this cut
};

/// Nothing of the volume is seen before the cut. Of several cuts the layer of the last one that the ray meets counts.
void cutNearer(const Camera& camera, PixelMaps& maps, std::size_t pixel, const Cut& cut);

/// Nothing of the volume is seen behind `distance`.
void cutFarther(const Camera& camera, PixelMaps& maps, std::size_t pixel, double distance);

/// An opaque point at `distance` with that colour (RGB, display values), where it is nearer than what is there already.
void putOpaque(const Camera& camera, PixelMaps& maps, std::size_t pixel, double distance, const glm::vec3& color);

/// \throws std::runtime_error when a vector of the maps is neither empty nor of the camera's size, or translucent
/// fragments lie outside the image or in no order.
void checkPixelMaps(const View& view);

/// Puts `maps.behind` under the finished volume.
void composeBehind(Image& image, const PixelMaps& maps);

}  // namespace tetralux::projection
