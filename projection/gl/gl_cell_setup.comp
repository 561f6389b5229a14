// SPDX-License-Identifier: Apache-2.0
//
// One cell of a chunk to what the vertex shader reads of it (gl_cell_stream.h): outline, CellRecord, gradient, corners.
layout(std430, binding = 3) readonly buffer Scalars { double scalars[]; };  // the field's own units
layout(std430, binding = 4) readonly buffer Keyed { uvec2 keyed[]; };
layout(std430, binding = 5) writeonly buffer Vertices { uint vertices[]; };
#if TETRALUX_GRADIENT
layout(std430, binding = 6) readonly buffer Gradients { vec4 gradients[]; };
#endif
#if TETRALUX_ATTRIBUTES
layout(std430, binding = 7) readonly buffer AttributeRows { uvec4 attributeRows[]; };  // of the cells' corners
#endif

uniform uint chunkBegin, chunkCells, reversed;  // reversed: from the last cell of the order on
uniform double margin;                     // pixels
uniform double scalarOffset, scalarScale;  // SceneUnits

void store(uint at, float value) { vertices[at] = floatBitsToUint(value); }

// `order` by which the points ascend; true when that turns the cell inside out.
bool sortCorners(uvec4 points, out int order[4]) {
    int inversions = 0;
    for (int k = 0; k < 4; ++k) {
        int rank = 0;
        for (int j = 0; j < 4; ++j) {
            rank += points[j] < points[k] ? 1 : 0;
            inversions += j > k && points[j] < points[k] ? 1 : 0;
        }
        order[rank] = k;
    }
    return inversions % 2 != 0;
}

void main() {
    uint slot = itemNumber(), place = chunkBegin + slot;
    if (slot >= chunkCells || place >= plan.drawn) return;
    uint cell = keyed[reversed != 0 ? plan.drawn - 1 - place : place].y;
    uvec4 points = cells[cell];
    CellView view = cellView();
    uint base = slot * TETRALUX_CELL_FLOATS;

    dvec3 corners[4];
    for (int k = 0; k < 4; ++k) corners[k] = cameraPoint(points[k]);
    OutlineCorners outline = outlineOfCell(corners, view, margin);
    for (int k = 0; k < 4; ++k) {
        uint at = base + 2 * ((k + 3) % 4);  // corners 1, 2, 3, 0
        store(at, float(outline.at[k].x));
        store(at + 1, float(outline.at[k].y));
    }

    int order[4];
    bool odd = sortCorners(points, order);
    dvec3 v[4];
    double raw[4], s[4];
    for (int i = 0; i < 4; ++i) {
        v[i] = corners[order[i]];
        raw[i] = scalars[TETRALUX_CELL_DATA != 0 ? cell : points[order[i]]];
        s[i] = (raw[i] - scalarOffset) / scalarScale;
    }
    CellForms forms = cellForms(v[0], v[1], v[2], v[3], view.orthographic);
    CellReference reference = referenceOfCell(forms, v, view);
    ProjectedCell projected = projectCell(forms, reference, s, sceneRise(riseOf(raw), scalarScale), view.orthographic);
    int frontMask = 0;
    uint record = base + 8;
    for (int i = 0; i < 4; ++i) {
        int k = order[i];
        if ((forms.eye[i] < 0.0lf) != odd) frontMask |= 1 << k;
        for (int j = 0; j < 3; ++j) store(record + 3 * k + j, float(projected.plane[i][j]));
#if TETRALUX_ATTRIBUTES
        double weight = (odd ? -eyeBesideFace(forms, i) : eyeBesideFace(forms, i)) / abs(forms.determinant);
        store(base + 36 + k, float(view.orthographic ? weight * abs(reference.depth) : weight));
        vertices[base + 40 + k] = attributeRows[cell][k];
#endif
    }
    for (int i = 12; i < 24; ++i) store(record + i, float(recordValue(i, projected, reference, s, frontMask, view)));
#if TETRALUX_GRADIENT
    for (int j = 0; j < 4; ++j) store(base + 32 + j, gradients[cell][j]);
#endif
}
