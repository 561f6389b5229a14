// SPDX-License-Identifier: Apache-2.0
//
// Between which rho and which nearness a cell lies. After projected_cell.glsl, in the same namespace.

inline constexpr double largestRho = 1e15;

struct DepthBounds {
    wide rhoNear, rhoFar, nearness, nearnessPerRho, rounding;
};

/// Nearness is zRef/z − 1 in perspective, zRef − z in orthographic views.
TETRALUX_CELL_FUNCTION DepthBounds depthBounds(double depthReference, const wide& depth, const wide& perDepth, const wide& nearest, const wide& deepest,
                                               bool orthographic) {
    DepthBounds bounds;
    const wide one(1.0), reference(depthReference), slack(1e-6);
    if (orthographic) {
        bounds.rhoNear = (depth - nearest) * abs(perDepth);
        bounds.rhoFar = (depth - deepest) * abs(perDepth);
        bounds.nearnessPerRho = abs(depth);
        bounds.nearness = reference - depth;
    } else {
        const wide inverse = one / (nearest * deepest);
        bounds.rhoNear = (depth - nearest) * (inverse * deepest);
        bounds.rhoFar = (depth - deepest) * (inverse * nearest);
        bounds.nearnessPerRho = reference * perDepth;
        bounds.nearness = (reference - depth) * perDepth;
    }
    const wide widening = slack * (bounds.rhoNear - bounds.rhoFar);
    bounds.rhoNear = bounds.rhoNear + widening;
    bounds.rhoFar = bounds.rhoFar - widening;
    if (orthographic) bounds.rhoNear = min(bounds.rhoNear, copySign(one, depth));  // the eye's plane
    bounds.rounding = wide(3e-7) * (abs(bounds.nearness) + bounds.nearnessPerRho * (bounds.rhoNear - bounds.rhoFar));
    return bounds;
}
