// SPDX-License-Identifier: Apache-2.0
/// \file
/// How far look-up is from the exact integral: single segments and whole rays, along which errors of many thin segments
/// add up.
#pragma once

#include <vector>

#include <preint/preintegration_table.h>

namespace tetralux::preint {

/// A ray: consecutive segments scalar[i] → scalar[i+1] over length[i], and what they add up to exactly. A single
/// segment is a ray of one.
struct SampleRay {
    std::vector<double> scalars, lengths;
    SegmentResult exact;
};

/// The same rays for the same arguments, on every machine: some 1500 single segments (long, short, about nodes) and 36
/// rays of 30 to 400 random steps that sweep the range or oscillate in part of it.
std::vector<SampleRay> sampleRays(const ExactIntegral& exact, const PreintegrationTable& layout);

/// What two results of a ray differ by: premultiplied colour or opacity at its end, or the mean colour of a ray that is
/// one segment (0 where nothing shows).
enum class Compared { PremultipliedColor, MeanColor };

/// The largest difference of any ray.
double lookUpError(const PreintegrationTable& table, const std::vector<SampleRay>& rays, Compared compared);

/// The same for a table of that layout that is not built: texels are computed as they are needed.
double lookUpError(const ExactIntegral& exact, const PreintegrationTable& layout, const std::vector<SampleRay>& rays,
                   Compared compared);

}  // namespace tetralux::preint
