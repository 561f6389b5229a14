// SPDX-License-Identifier: Apache-2.0
/// \file
/// What fast engines look up: 2D (scale-invariant, Kraus 2005) and 3D (standard) tables of one transfer function.
///
/// A texel holds (mean colour, mean extinction): C/α as RGB and (Θ(s_b) − Θ(s_f))/(s_b − s_f). Both are smooth where C
/// and α themselves have a singular diagonal, so that bilinear look-up keeps thin segments exact to first order:
/// opticalDepth = meanExtinction·(length or |s_b − s_f|), C = meanColor·(1 − exp(−opticalDepth)). Mean extinction does
/// not depend on the length at all, mean colour varies slowly with it.
///
/// Isosurfaces and jumps are not in the table: they are `Discontinuity`s at which a segment is split before look-up, so
/// they are exact. Between two jumps lies a zone with a square block of texels of its own.
///
/// Nodes of the transfer function are kinks, across which interpolation errs most. So the mapping from scalar to texel
/// is not linear but piecewise linear (`warped`): the strongest kinks lie at texel centres, and narrow pieces between
/// them get texels enough. Short segments, which lie within one piece, then see a table without kinks.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <preint/exact_integral.h>

namespace tetralux::preint {

/// A scalar at which segments are split: an isosurface (opacity > 0), a jump (opacity 0, the zone changes), or both.
struct Discontinuity {
    double value = 0.0;
    double opacity = 0.0;
    glm::dvec3 color{0};
    int zoneBelow = 0, zoneAbove = 0;
};

struct TableOptions {
    double wantedError = 1e-4;  ///< largest error of a segment's premultiplied colour and opacity at sampled segments
    int size = 0;               ///< texels per zone and scalar axis; 0: the smallest that keeps wantedError
    int lengthSlices = 0;       ///< 3D only; 0: chosen
    /// Try first, with up to 16 MiB, texels that lie evenly over each zone and hold extinction too: no `warp`, no
    /// `ramps`. The cheapest look-up, for engines to which arithmetic costs more than texels.
    bool evenTexelsFirst = false;
    /// What is wanted of the table is the mean colour of single segments, however faint they are, as pictures of the
    /// first hit show it: `wantedError` is of that.
    bool meanColors = false;
};

/// Texels of one table, all zones stacked: zone z, back j, front i, slice k at
/// texels[((k·zoneCount + z)·size + j)·size + i].
struct PreintegrationTable {
    Integral integral = Integral::ScaleInvariant;
    int size = 0;                   ///< texels per scalar axis within a zone
    int slices = 1;                 ///< length axis: 1 for 2D
    double lengthMax = 0;           ///< mesh units; longer segments use the last slice
    double lengthScale = 1;         ///< curvature of the length mapping (table_lookup.glsl)
    std::vector<glm::dvec2> zones;  ///< scalar range [low, high] of each zone, ascending, within the field's range
    std::vector<Discontinuity> discontinuities;  ///< ascending by value
    /// The mapping from scalar to table coordinate (zone + fraction of the zone's texels): Σ warp[k].y·max(s −
    /// warp[k].x, 0). Where `warped` is false it is linear within each zone, and `zones` alone tell it.
    std::vector<glm::dvec2> warp;
    bool warped = false;
    /// Extinction itself, where the transfer function has few nodes: τ(s) = Σ over k with s ≥ ramps[k].x of
    /// ramps[k].y + 2·ramps[k].z·(s − ramps[k].x), with jump and half the change of slope at each node, first of all
    /// the low end of the range. Its mean over a segment is exact; the texels' own serves functions of many nodes,
    /// whose `ramps` are empty.
    std::vector<glm::dvec3> ramps;
    std::vector<double> texelScalars;  ///< scalar at the centre of texel i of zone z: texelScalars[z·size + i]
    std::vector<glm::vec4> texels;

    double measuredError = 0.0;  ///< over sampled segments, against ExactIntegral
    double buildMilliseconds = 0.0;
};

/// Scale-invariant table over [scalarMin, scalarMax], O(n²) by the recurrence of neighbouring texels.
PreintegrationTable buildScaleInvariantTable(const ExactIntegral& exact, double scalarMin, double scalarMax,
                                             const TableOptions& options);

/// Standard table over [scalarMin, scalarMax] × [0, lengthMax].
PreintegrationTable buildStandardTable(const ExactIntegral& exact, double scalarMin, double scalarMax, double lengthMax,
                                       const TableOptions& options);

/// The segment as engines see it, through the shared look-up text, in double: for tests and error measurement.
SegmentResult lookUpSegment(const PreintegrationTable& table, double front, double back, double length);

}  // namespace tetralux::preint
