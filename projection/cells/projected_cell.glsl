// SPDX-License-Identifier: Apache-2.0
//
// The derivation of projected cells (cell_interval.glsl), one text for GLSL's doubles (gl_cell_setup.comp), for C++'s
// (projected_cell.h) and for SIMD lanes of them (cpu_cell_batch.h). Included inside a namespace (no guard): once for
// doubles, and once per instruction set between Highway's HWY_BEFORE_NAMESPACE and HWY_AFTER_NAMESPACE. `wide` is the
// number: + - * /, unary -, <, wide(double), abs, min, max, select(condition, wide, wide), copySign(magnitude, sign).
// Triple is three of them (cell_triple.inl, dvec3). TETRALUX_CELL_FUNCTION stands before each function,
// TETRALUX_CELL_IN(type) and TETRALUX_CELL_INOUT(type) for parameters. `orthographic` is known when compiling,
// always.
//
// Corners come in ascending order of their point numbers, so that the two cells of a face compute the same numbers
// for it without sorting faces.

// Barycentric forms of a cell with corners a, b, c, d: λ_k(p) = (eye[k] + dot(normal[k], p))/determinant in the space
// of CameraPoint. All carry the sign of the corners' orientation. Orthographic: eye[k] is the rate of determinant·λ_k
// towards the eye.
struct CellForms {
    Triple a, ab, ac, ad;
    Triple normal[4];
    wide eye[4];
    wide determinant;
};

// det(p, q − p, r − p): the face's side seen from the eye (orthographic: its extent across the view).
TETRALUX_CELL_FUNCTION wide faceSide(TETRALUX_CELL_IN(Triple) p, TETRALUX_CELL_IN(Triple) pq, TETRALUX_CELL_IN(Triple) pr, bool orthographic) {
    if (orthographic) return pq.x * pr.y - pq.y * pr.x;
    return dot(p, cross(pq, pr));
}

TETRALUX_CELL_FUNCTION CellForms cellForms(TETRALUX_CELL_IN(Triple) a, TETRALUX_CELL_IN(Triple) b, TETRALUX_CELL_IN(Triple) c,
                                           TETRALUX_CELL_IN(Triple) d, bool orthographic) {
    CellForms forms;
    forms.a = a;
    forms.ab = b - a;
    forms.ac = c - a;
    forms.ad = d - a;
    forms.normal[1] = cross(forms.ac, forms.ad);
    forms.normal[2] = cross(forms.ad, forms.ab);
    forms.normal[3] = cross(forms.ab, forms.ac);
    Triple sum = forms.normal[1] + forms.normal[2] + forms.normal[3];
    forms.normal[0] = Triple(-sum.x, -sum.y, -sum.z);
    forms.determinant = dot(forms.ab, forms.normal[1]);
    // outward faces of a positive cell are b c d, a d c, a b d, a c b: corners in ascending order make every other
    // one negative sums with 0 so that a face seen edge-on has +0: whoever compares with 0 and whoever copies the
    // sign must agree
    wide zero = wide(0.0);
    forms.eye[0] = zero + faceSide(b, c - b, d - b, orthographic);
    forms.eye[1] = zero - faceSide(a, forms.ac, forms.ad, orthographic);
    forms.eye[2] = zero + faceSide(a, forms.ab, forms.ad, orthographic);
    forms.eye[3] = zero - faceSide(a, forms.ab, forms.ac, orthographic);
    return forms;
}

// eye[k], not quite 0 where face k is seen edge-on: its plane, which is divided by that, stays finite, and what
// multiplies the plane by it again still finds λ_k.
TETRALUX_CELL_FUNCTION wide eyeBesideFace(TETRALUX_CELL_IN(CellForms) forms, int k) {
    wide least = abs(forms.determinant) * wide(leastEyeCoordinate) + wide(leastDeterminant);
    return copySign(max(abs(forms.eye[k]), least), forms.eye[k]);
}

// Where a cell's numbers refer to: image position (pixels from the optical axis) and depth.
struct CellReference {
    wide imageX, imageY, depth, perDepth;  // perDepth = 1/depth
    wide coordinate[4];  // λ_k there
};

// The centroid: for cells well in front of the eye.
TETRALUX_CELL_FUNCTION CellReference centroidReference(TETRALUX_CELL_IN(CellForms) forms, bool orthographic) {
    wide quarter = wide(0.25);
    CellReference reference;
    reference.depth = forms.a.z + quarter * (forms.ab.z + forms.ac.z + forms.ad.z);
    reference.imageX = forms.a.x + quarter * (forms.ab.x + forms.ac.x + forms.ad.x);
    reference.imageY = forms.a.y + quarter * (forms.ab.y + forms.ac.y + forms.ad.y);
    if (orthographic) {
        wide least = wide(leastDepth);
        reference.depth = select(abs(reference.depth) < least, least, reference.depth);
    }
    reference.perDepth = wide(1.0) / reference.depth;
    if (!orthographic) {
        reference.imageX = reference.imageX * reference.perDepth;
        reference.imageY = reference.imageY * reference.perDepth;
    }
    for (int k = 0; k < 4; ++k) reference.coordinate[k] = quarter;
    return reference;
}

// Any point in front of the eye: for cells that reach behind it, in perspective.
TETRALUX_CELL_FUNCTION void coordinatesAt(TETRALUX_CELL_IN(CellForms) forms, TETRALUX_CELL_INOUT(CellReference) reference) {
    wide inverse = wide(1.0) / forms.determinant;
    Triple ray = Triple(reference.imageX, reference.imageY, wide(1.0));
    for (int k = 0; k < 4; ++k)
        reference.coordinate[k] = (forms.eye[k] + reference.depth * dot(forms.normal[k], ray)) * inverse;
}

// The float record of projection/cells/cell_interval.glsl, before it becomes float.
struct ProjectedCell {
    wide plane[4][3];
    wide scalar, scalarPerX, scalarPerY, scalarPerInverseDepth;
    Triple gradient;  // of the scalar in the space of CameraPoint
};

// What corners 1, 2 and 3 have more than corner 0.
TETRALUX_CELL_FUNCTION Triple riseOf(const wide s[4]) { return Triple(s[1] - s[0], s[2] - s[0], s[3] - s[0]); }

// A rise in the field's own units to scene units. Differences of the field's numbers are exact where they nearly
// agree; those of scene scalars are not.
TETRALUX_CELL_FUNCTION Triple sceneRise(TETRALUX_CELL_IN(Triple) rise, wide scalarScale) {
    return Triple(rise.x / scalarScale, rise.y / scalarScale, rise.z / scalarScale);
}

// `rise`: riseOf(s), or sceneRise of the field's own.
TETRALUX_CELL_FUNCTION ProjectedCell projectCell(TETRALUX_CELL_IN(CellForms) forms, TETRALUX_CELL_IN(CellReference) reference, const wide s[4],
                                                 TETRALUX_CELL_IN(Triple) rise, bool orthographic) {
    ProjectedCell cell;
    wide size = abs(forms.determinant);
    wide lateral = orthographic ? wide(1.0) : reference.depth;
    wide inverseDepthToDepth = orthographic ? abs(reference.depth) : reference.depth;
    wide bound = wide(largestPlane);
    wide eye[4];
    wide inverse[4];
    for (int k = 0; k < 4; ++k) eye[k] = eyeBesideFace(forms, k);
    for (int k = 0; k < 4; k += 2) {  // one division for two
        wide both = wide(-1.0) / (eye[k] * eye[k + 1]);
        inverse[k] = both * eye[k + 1];
        inverse[k + 1] = both * eye[k];
    }
    for (int k = 0; k < 4; ++k) {
        wide perEye = orthographic ? inverse[k] * abs(reference.perDepth) : inverse[k];
        cell.plane[k][0] = min(max(forms.determinant * reference.coordinate[k] * perEye, -bound), bound);
        cell.plane[k][1] = min(max(lateral * forms.normal[k].x * perEye, -bound), bound);
        cell.plane[k][2] = min(max(lateral * forms.normal[k].y * perEye, -bound), bound);
    }
    // from differences, so that a constant scalar has exactly no gradient
    wide perDeterminant = wide(1.0) / copySign(max(size, wide(leastDeterminant)), forms.determinant);
    cell.gradient = (rise.x * perDeterminant) * forms.normal[1] + (rise.y * perDeterminant) * forms.normal[2] +
                    (rise.z * perDeterminant) * forms.normal[3];
    cell.scalar = s[0] + rise.x * reference.coordinate[1] + rise.y * reference.coordinate[2] + rise.z * reference.coordinate[3];
    cell.scalarPerX = lateral * cell.gradient.x;
    cell.scalarPerY = lateral * cell.gradient.y;
    wide alongDepth = orthographic ? cell.gradient.z
                                   : cell.gradient.x * reference.imageX + cell.gradient.y * reference.imageY + cell.gradient.z;
    cell.scalarPerInverseDepth = -inverseDepthToDepth * alongDepth;
    return cell;
}
