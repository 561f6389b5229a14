// SPDX-License-Identifier: Apache-2.0
/// \file
/// Internal: second moments of a disc of which a part was not seen, because there the mesh ends.
#pragma once

#include <array>
#include <cstddef>

namespace tetralux::shading {

/// A unit disc by direction: direction k is at the angle 2π(k + ½)/directions. Sums over what lies within the mesh,
/// of (1 − ρ²)·ρ^m dρ for m = 1, 3 and 5.
struct SeenDisc {
    static constexpr std::size_t directions = 32;
    using Values = std::array<float, directions>;
    Values first{}, third{}, fifth{};

    /// The integrals from 0 to ρ.
    static float firstTo(float square) { return square * (0.5f - 0.25f * square); }
    static float thirdTo(float square) { return square * square * (0.25f - square / 6); }
    static float fifthTo(float square) { return square * square * square * (1.0f / 6 - 0.125f * square); }
};

/// Second moments per weight.
struct DiscMoments {
    double xx, yy, xy;
};

/// What `found`, the moments over the part of the disc that is `seen`, would be over all of it. The density is taken to
/// be (1 − ρ²)(c₀ + c₁x² + c₂y² + c₃xy): even, as it is about a point of a quadric. What is found gives four equations
/// for the four cs; ridges hold c₁, c₂, c₃ near 0 (a plane) where neither a direction nor its opposite is seen, since
/// there evenness tells nothing.
DiscMoments completed(const SeenDisc& seen, const DiscMoments& found);

}  // namespace tetralux::shading
