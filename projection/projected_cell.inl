// SPDX-License-Identifier: Apache-2.0
//
// The derivation of projected cells (cell_interval.glsl) for any number type R: double for one cell (projected_cell.h), SIMD doubles for a batch.
// Included inside a namespace (no guard): once for doubles, and once per instruction set between Highway's HWY_BEFORE_NAMESPACE and
// HWY_AFTER_NAMESPACE. R needs + - * /, unary -, <, explicit R(double), and abs, min, max, select(condition, R, R), copySign(magnitude, sign).
// TETRALUX_CELL_FUNCTION stands before each function.
//
// Corners come in ascending order of their point numbers, so that the two cells of a face compute the same numbers for it without sorting faces.

template <class R>
struct Triple {
    R x, y, z;
};
template <class R>
TETRALUX_CELL_FUNCTION Triple<R> operator-(const Triple<R>& a, const Triple<R>& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class R>
TETRALUX_CELL_FUNCTION Triple<R> cross(const Triple<R>& a, const Triple<R>& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <class R>
TETRALUX_CELL_FUNCTION R dot(const Triple<R>& a, const Triple<R>& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

/// Barycentric forms of a cell with corners a, b, c, d: λ_k(p) = (eye[k] + dot(normal[k], p))/determinant in the space of CameraPoint. All carry the
/// sign of the corners' orientation. Orthographic: eye[k] is the rate of determinant·λ_k towards the eye.
template <class R>
struct CellForms {
    Triple<R> a, ab, ac, ad;
    Triple<R> normal[4];
    R eye[4];
    R determinant;
};

/// det(p, q − p, r − p): the face's side seen from the eye (orthographic: its extent across the view).
template <class R, bool Orthographic>
TETRALUX_CELL_FUNCTION R faceSide(const Triple<R>& p, const Triple<R>& pq, const Triple<R>& pr) {
    if constexpr (Orthographic) {
        return pq.x * pr.y - pq.y * pr.x;
    } else {
        return dot(p, cross(pq, pr));
    }
}

template <class R, bool Orthographic>
TETRALUX_CELL_FUNCTION CellForms<R> cellForms(const Triple<R>& a, const Triple<R>& b, const Triple<R>& c, const Triple<R>& d) {
    CellForms<R> forms;
    forms.a = a;
    forms.ab = b - a;
    forms.ac = c - a;
    forms.ad = d - a;
    forms.normal[1] = cross(forms.ac, forms.ad);
    forms.normal[2] = cross(forms.ad, forms.ab);
    forms.normal[3] = cross(forms.ab, forms.ac);
    const auto &n1 = forms.normal[1], &n2 = forms.normal[2], &n3 = forms.normal[3];
    forms.normal[0] = {-(n1.x + n2.x + n3.x), -(n1.y + n2.y + n3.y), -(n1.z + n2.z + n3.z)};
    forms.determinant = dot(forms.ab, n1);
    // outward faces of a positive cell are b c d, a d c, a b d, a c b: corners in ascending order make every other one negative
    // sums with 0 so that a face seen edge-on has +0: whoever compares with 0 and whoever copies the sign must agree
    const R zero(0.0);
    forms.eye[0] = zero + faceSide<R, Orthographic>(b, c - b, d - b);
    forms.eye[1] = zero - faceSide<R, Orthographic>(a, forms.ac, forms.ad);
    forms.eye[2] = zero + faceSide<R, Orthographic>(a, forms.ab, forms.ad);
    forms.eye[3] = zero - faceSide<R, Orthographic>(a, forms.ab, forms.ac);
    return forms;
}

/// Where a cell's numbers refer to: image position (pixels from the optical axis) and depth.
template <class R>
struct CellReference {
    R imageX, imageY, depth, perDepth;  ///< perDepth = 1/depth
    R coordinate[4];  ///< λ_k there
};

/// The centroid: for cells well in front of the eye.
template <class R, bool Orthographic>
TETRALUX_CELL_FUNCTION CellReference<R> centroidReference(const CellForms<R>& forms) {
    const R quarter(0.25);
    CellReference<R> reference;
    reference.depth = forms.a.z + quarter * (forms.ab.z + forms.ac.z + forms.ad.z);
    reference.imageX = forms.a.x + quarter * (forms.ab.x + forms.ac.x + forms.ad.x);
    reference.imageY = forms.a.y + quarter * (forms.ab.y + forms.ac.y + forms.ad.y);
    if constexpr (Orthographic) {
        const R least(1e-9);
        reference.depth = select(abs(reference.depth) < least, least, reference.depth);
    }
    reference.perDepth = R(1.0) / reference.depth;
    if constexpr (!Orthographic) {
        reference.imageX = reference.imageX * reference.perDepth;
        reference.imageY = reference.imageY * reference.perDepth;
    }
    for (auto& coordinate : reference.coordinate) coordinate = quarter;
    return reference;
}

/// Any point in front of the eye: for cells that reach behind it.
template <class R, bool Orthographic>
TETRALUX_CELL_FUNCTION void coordinatesAt(const CellForms<R>& forms, CellReference<R>& reference) {
    const R inverse = R(1.0) / forms.determinant;
    for (int k = 0; k < 4; ++k) {
        const Triple<R> ray{reference.imageX, reference.imageY, R(1.0)};
        reference.coordinate[k] = (forms.eye[k] + reference.depth * dot(forms.normal[k], ray)) * inverse;
    }
}

/// The float record of projection/cell_interval.glsl, before it becomes float.
template <class R>
struct ProjectedCell {
    R plane[4][3];
    R scalar, scalarPerX, scalarPerY, scalarPerRho;
    Triple<R> gradient;  ///< of the scalar in the space of CameraPoint
};

/// Bounds of plane coefficients, so that what is computed from them in float stays finite.
inline constexpr double largestPlane = 1e30;
/// Least |λ(eye)| of a face: its plane stays finite when it is seen edge-on.
inline constexpr double leastEyeCoordinate = 1e-20, leastDeterminant = 1e-140;

template <class R, bool Orthographic>
TETRALUX_CELL_FUNCTION ProjectedCell<R> projectCell(const CellForms<R>& forms, const CellReference<R>& reference, const R (&s)[4]) {
    ProjectedCell<R> cell;
    const R size = abs(forms.determinant);
    const R lateral = Orthographic ? R(1.0) : reference.depth;
    const R rhoToDepth = Orthographic ? abs(reference.depth) : reference.depth;
    const R leastEye = size * R(leastEyeCoordinate) + R(leastDeterminant), bound(largestPlane);
    R eye[4], inverse[4];
    for (int k = 0; k < 4; ++k) eye[k] = copySign(max(abs(forms.eye[k]), leastEye), forms.eye[k]);
    for (int k = 0; k < 4; k += 2) {  // one division for two
        const R both = R(-1.0) / (eye[k] * eye[k + 1]);
        inverse[k] = both * eye[k + 1];
        inverse[k + 1] = both * eye[k];
    }
    for (int k = 0; k < 4; ++k) {
        const R perEye = Orthographic ? inverse[k] * abs(reference.perDepth) : inverse[k];
        const R values[3] = {forms.determinant * reference.coordinate[k] * perEye, lateral * forms.normal[k].x * perEye,
                             lateral * forms.normal[k].y * perEye};
        for (int j = 0; j < 3; ++j) cell.plane[k][j] = min(max(values[j], -bound), bound);
    }
    // from differences, so that a constant scalar has exactly no gradient
    const R perDeterminant = R(1.0) / copySign(max(size, R(leastDeterminant)), forms.determinant);
    const R d1 = (s[1] - s[0]) * perDeterminant, d2 = (s[2] - s[0]) * perDeterminant, d3 = (s[3] - s[0]) * perDeterminant;
    const auto &n1 = forms.normal[1], &n2 = forms.normal[2], &n3 = forms.normal[3];
    cell.gradient = {d1 * n1.x + d2 * n2.x + d3 * n3.x, d1 * n1.y + d2 * n2.y + d3 * n3.y, d1 * n1.z + d2 * n2.z + d3 * n3.z};
    cell.scalar = s[0] + (s[1] - s[0]) * reference.coordinate[1] + (s[2] - s[0]) * reference.coordinate[2] +
                  (s[3] - s[0]) * reference.coordinate[3];
    cell.scalarPerX = lateral * cell.gradient.x;
    cell.scalarPerY = lateral * cell.gradient.y;
    const R alongDepth = Orthographic ? cell.gradient.z
                                      : cell.gradient.x * reference.imageX + cell.gradient.y * reference.imageY + cell.gradient.z;
    cell.scalarPerRho = -rhoToDepth * alongDepth;
    return cell;
}

inline constexpr double largestRho = 1e15;

template <class R>
struct DepthBounds {
    R rhoNear, rhoFar, nearness, nearnessPerRho, rounding;
};

/// Nearness is zRef/z − 1 in perspective, zRef − z in orthographic views.
template <class R, bool Orthographic>
TETRALUX_CELL_FUNCTION DepthBounds<R> depthBounds(double depthReference, const R& depth, const R& perDepth, const R& nearest, const R& deepest) {
    DepthBounds<R> bounds;
    const R one(1.0), reference(depthReference), slack(1e-6);
    if constexpr (Orthographic) {
        bounds.rhoNear = (depth - nearest) * abs(perDepth);
        bounds.rhoFar = (depth - deepest) * abs(perDepth);
        bounds.nearnessPerRho = abs(depth);
        bounds.nearness = reference - depth;
    } else {
        const R inverse = one / (nearest * deepest);
        bounds.rhoNear = (depth - nearest) * (inverse * deepest);
        bounds.rhoFar = (depth - deepest) * (inverse * nearest);
        bounds.nearnessPerRho = reference * perDepth;
        bounds.nearness = (reference - depth) * perDepth;
    }
    const R widening = slack * (bounds.rhoNear - bounds.rhoFar);
    bounds.rhoNear = bounds.rhoNear + widening;
    bounds.rhoFar = bounds.rhoFar - widening;
    if constexpr (Orthographic) bounds.rhoNear = min(bounds.rhoNear, copySign(one, depth));  // the eye's plane
    bounds.rounding = R(3e-7) * (abs(bounds.nearness) + bounds.nearnessPerRho * (bounds.rhoNear - bounds.rhoFar));
    return bounds;
}
