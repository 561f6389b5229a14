// SPDX-License-Identifier: Apache-2.0
/// \file
/// Internal: what one segment of a reference ray shows before silhouette and light, by mode and classification.
#pragma once

#include <optional>
#include <vector>

#include <preint/exact_integral.h>
#include <projection/reference/reference_ray_caster.h>

namespace tetralux::projection {

/// Colour per depth that is seen, and optical depths. In modes that hide nothing the colour is ∫ c τ/∫ τ and an
/// isosurface's depth its opacity.
struct UnshadedSegment {
    glm::dvec3 meanColor{0};
    double depth = 0.0;        ///< all of it
    double smoothDepth = 0.0;  ///< without isosurfaces
};

/// `middle` of the segment, mesh units, is where pre-classification interpolates. `scale`: the pixel's factor of
/// extinction, which `exact` has already.
UnshadedSegment unshadedSegment(const preint::ExactIntegral& exact, const Scene& scene, const RaySegment& segment,
                                const glm::dvec3& middle, double scale);

/// Cuts a segment to what lies between two distances; false when nothing does.
bool limit(RaySegment& segment, double nearest, double farthest);

/// Splits the segment at the end of a cut's layer, and tells which ones lie within.
void splitAtLayerEnd(std::vector<RaySegment>& segments, double layerEnd);

/// The function with extinction and the depth of its isosurfaces multiplied by `scale`.
preint::TransferFunction scaledExtinction(preint::TransferFunction function, double scale);

/// Distance along the ray to the first point of the segment with τ > 0 or an isosurface.
std::optional<double> firstShownAt(const preint::ExactIntegral& exact, const RaySegment& segment);

}  // namespace tetralux::projection
