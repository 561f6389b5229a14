// SPDX-License-Identifier: Apache-2.0
//
// Between which inverse depths a cell lies, its own (cell_interval.glsl) and those along rays. After
// projected_cell.glsl, in the same namespace.

inline constexpr double largestInverseDepth = 1e15;

struct DepthBounds {
    wide inverseDepthNear, inverseDepthFar, rayInverseDepth, rayPerInverseDepth, rounding;
};

/// Inverse depth is zRef/z − 1 in perspective, zRef − z in orthographic views.
TETRALUX_CELL_FUNCTION DepthBounds depthBounds(double depthReference, const wide& depth, const wide& perDepth, const wide& nearest, const wide& deepest,
                                               bool orthographic) {
    DepthBounds bounds;
    const wide one(1.0), reference(depthReference), slack(1e-6);
    if (orthographic) {
        bounds.inverseDepthNear = (depth - nearest) * abs(perDepth);
        bounds.inverseDepthFar = (depth - deepest) * abs(perDepth);
        bounds.rayPerInverseDepth = abs(depth);
        bounds.rayInverseDepth = reference - depth;
    } else {
        const wide inverse = one / (nearest * deepest);
        bounds.inverseDepthNear = (depth - nearest) * (inverse * deepest);
        bounds.inverseDepthFar = (depth - deepest) * (inverse * nearest);
        bounds.rayPerInverseDepth = reference * perDepth;
        bounds.rayInverseDepth = (reference - depth) * perDepth;
    }
    const wide widening = slack * (bounds.inverseDepthNear - bounds.inverseDepthFar);
    bounds.inverseDepthNear = bounds.inverseDepthNear + widening;
    bounds.inverseDepthFar = bounds.inverseDepthFar - widening;
    if (orthographic) bounds.inverseDepthNear = min(bounds.inverseDepthNear, copySign(one, depth));  // the eye's plane
    bounds.rounding = wide(3e-7) * (abs(bounds.rayInverseDepth) + bounds.rayPerInverseDepth * (bounds.inverseDepthNear - bounds.inverseDepthFar));
    return bounds;
}
