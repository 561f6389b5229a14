// SPDX-License-Identifier: Apache-2.0
/// \file
/// Opaque slices and surfaces within the volume: found once per pixel in double precision, the same for all engines.
/// An engine composes the volume only as far as them, and they are put under its picture: C = C_volume + T·C_layer.
/// Slices with an opacity below 1 stand between parts of the volume (PixelMaps::translucent).
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include <glm/vec3.hpp>

#include <projection/core/camera.h>
#include <projection/core/pixel_maps.h>
#include <projection/core/scene.h>
#include <projection/light/light_shadows.h>
#include <projection/opaque/isoline_pixels.h>
#include <projection/opaque/opaque_objects.h>

namespace tetralux::projection {

struct RayFrame;
struct TriangleCrossing;

/// One of a scene's map sources; it comes behind clip planes, which leave out parts of slices (surfaces stay whole).
class OpaqueLayer final : public PixelMapSource {
public:
    /// Cuts the slices out of the scene's mesh; its transfer function colours them, its lights fall on the surfaces.
    /// Where there are shadows, the volume and the scene's shadow casters cast them on surfaces and slices. Slices
    /// whose opacity is below 1 become translucent fragments, isolines are opaque on any. \throws std::runtime_error
    /// when a slice misses the mesh, or has an opacity in a mode that composes no parts.
    OpaqueLayer(const Scene& scene, const OpaqueObjects& objects);

    void apply(const Camera& camera, PixelMaps& maps) const override;

private:
    class Frame;
    struct Triangle {
        std::array<mesh::PointIndex, 3> corners;
        double scalar;                        // cell data: of the cell
        std::uint32_t object;                 // slices first
        std::array<glm::dvec3, 3> normals{};  // of smooth surfaces, at the corners
    };
    struct Object {
        double opacity;
        bool clipped;
        bool ofCells = false;  // its scalars are of its triangles
    };

    void append(const mesh::SurfaceMesh& part, const Object& look, std::optional<double> featureAngle);
    double scalarAt(const Triangle& triangle, const TriangleCrossing& where) const;
    glm::dvec3 normalAt(const Triangle& triangle, const TriangleCrossing& where, const glm::dvec3& direction) const;
    glm::dvec3 surfaceColor(const OpaqueSurface& surface, const Triangle& triangle, const TriangleCrossing& where,
                            const RayFrame& ray, double distance, double edgeCover) const;
    glm::dvec3 atDepth(const glm::dvec3& color, const DepthRange& depths, double distance) const;
    glm::dvec3 sliceColor(const Triangle& triangle, const TriangleCrossing& where, const glm::dvec3& place,
                          const LineCover& line) const;

    mesh::BoundingBox bounds_;  // of the mesh
    preint::TransferFunction transferFunction_;
    shading::ShadingSettings shading_;
    ShadowAt shadowAt_;  // of the volume; empty: it casts none
    std::vector<Object> objects_;
    std::vector<std::vector<mesh::IsolineSegment>> isolines_;  // of each slice
    double isolineWidth_;                                      // pixels
    std::vector<glm::dvec3> isolineInks_;                      // by value
    std::vector<OpaqueSurface> surfaces_;
    std::vector<glm::dvec3> positions_;  // of all slices and surfaces
    std::vector<double> scalars_;        // of point data, one per position
    std::vector<Triangle> triangles_;
};

}  // namespace tetralux::projection
