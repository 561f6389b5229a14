// SPDX-License-Identifier: Apache-2.0
//
// The convex polygon of four corners that a projected cell is drawn as, one text for C++ (gl_cell_outline.cpp) and
// GLSL. After covered_pixels.glsl. Pair is two `wide` (dvec2) with their operators and dot.

struct OutlineCorners {
    Pair at[4];
};

TETRALUX_CELL_FUNCTION wide crossOf(TETRALUX_CELL_IN(Pair) a, TETRALUX_CELL_IN(Pair) b) { return a.x * b.y - a.y * b.x; }

// Vertex i of face k (mesh::faceVertices): outward counter-clockwise.
TETRALUX_CELL_FUNCTION int faceVertex(int k, int i) {
    int first = k == 0 ? 1 : 0, second = k == 1 ? 3 : k == 2 ? 1 : 2, third = k == 1 ? 2 : k == 3 ? 1 : 3;
    return i == 0 ? first : i == 1 ? second : third;
}

// A box along the hull's longest chord, grown by `margin`: covers needles and flat cells, whose hull has no usable
// corners.
TETRALUX_CELL_FUNCTION OutlineCorners boxOutline(TETRALUX_CELL_IN(OutlineCorners) corners, wide margin) {
    Pair chord = Pair(wide(1.0), wide(0.0));
    wide longest = wide(0.0);
    for (int i = 0; i < 4; ++i) {
        for (int j = i + 1; j < 4; ++j) {
            Pair difference = corners.at[j] - corners.at[i];
            wide squared = dot(difference, difference);
            if (squared > longest) {
                longest = squared;
                chord = difference;
            }
        }
    }
    Pair along = chord * (wide(1.0) / sqrt(dot(chord, chord)));
    Pair across = Pair(-along.y, along.x);
    Pair low = Pair(wide(0.0), wide(0.0)), high = low;  // relative to corner 0, along and across
    for (int i = 1; i < 4; ++i) {
        Pair offset = Pair(dot(corners.at[i] - corners.at[0], along), dot(corners.at[i] - corners.at[0], across));
        low = Pair(min(low.x, offset.x), min(low.y, offset.y));
        high = Pair(max(high.x, offset.x), max(high.y, offset.y));
    }
    low = low - Pair(margin, margin);
    high = high + Pair(margin, margin);
    OutlineCorners outline;
    outline.at[0] = corners.at[0] + low.x * along + low.y * across;
    outline.at[1] = corners.at[0] + high.x * along + low.y * across;
    outline.at[2] = corners.at[0] + high.x * along + high.y * across;
    outline.at[3] = corners.at[0] + low.x * along + high.y * across;
    return outline;
}

// The convex polygon `hull` (count corners, counter-clockwise) with every edge moved outwards by `margin`. False when
// a corner is too sharp for that.
TETRALUX_CELL_FUNCTION bool growPolygon(TETRALUX_CELL_IN(OutlineCorners) hull, int count, wide margin, TETRALUX_CELL_INOUT(OutlineCorners) outline) {
    Pair normal[4];  // of the edge from corner i to the next, outwards
    for (int i = 0; i < count; ++i) {
        Pair edge = hull.at[i + 1 < count ? i + 1 : 0] - hull.at[i];
        wide squared = dot(edge, edge);
        if (!(squared > wide(0.0))) return false;
        normal[i] = Pair(edge.y, -edge.x) * (wide(1.0) / sqrt(squared));
    }
    for (int i = 0; i < count; ++i) {
        Pair before = normal[i > 0 ? i - 1 : count - 1], after = normal[i];
        wide turn = wide(1.0) + dot(before, after);
        if (turn < wide(sharpestCorner)) return false;
        outline.at[i] = hull.at[i] + (margin / turn) * (before + after);
    }
    if (count == 3) outline.at[3] = outline.at[2];
    return true;
}

// The convex hull of a tetrahedron's projected corners, grown by `margin` pixels on every side.
TETRALUX_CELL_FUNCTION OutlineCorners hullOutline(TETRALUX_CELL_IN(OutlineCorners) corners, wide margin) {
    // Twice the projected area of each face, signed; the four sum to zero, so the hull is the union of the faces of
    // positive sign: one face, or two that share an edge, or all but one.
    int positive[4];
    int negative[4];
    int positives = 0, negatives = 0;
    for (int k = 0; k < 4; ++k) {
        Pair a = corners.at[faceVertex(k, 0)], b = corners.at[faceVertex(k, 1)], c = corners.at[faceVertex(k, 2)];
        if (crossOf(b - a, c - a) > wide(0.0)) {
            positive[positives++] = k;
        } else {
            negative[negatives++] = k;
        }
    }
    OutlineCorners hull = corners;
    int count = 3;
    if (positives == 1 || positives == 3) {
        int face = positives == 1 ? positive[0] : negative[0];
        bool back = positives == 3;  // that face shows its back: turn it counter-clockwise
        hull.at[0] = corners.at[faceVertex(face, 0)];
        hull.at[1] = corners.at[faceVertex(face, back ? 2 : 1)];
        hull.at[2] = corners.at[faceVertex(face, back ? 1 : 2)];
    } else if (positives == 2) {
        // the positive faces are opposite `positive[0]` and `positive[1]` and share the edge of the other two corners
        Pair a = corners.at[positive[0]], b = corners.at[negative[0]], c = corners.at[positive[1]], d = corners.at[negative[1]];
        bool turned = crossOf(c - a, d - b) < wide(0.0);
        hull.at[0] = a;
        hull.at[1] = turned ? d : b;
        hull.at[2] = c;
        hull.at[3] = turned ? b : d;
        count = 4;
        // The two triangles of the quadrilateral meet along corners 0 and 2: a short seam shades fewer blocks of
        // pixels twice.
        Pair seam = c - a, other = hull.at[3] - hull.at[1];
        if (dot(other, other) < dot(seam, seam)) {
            Pair first = hull.at[0];
            hull.at[0] = hull.at[1];
            hull.at[1] = hull.at[2];
            hull.at[2] = hull.at[3];
            hull.at[3] = first;
        }
    } else {
        return boxOutline(corners, margin);
    }
    OutlineCorners outline = hull;
    if (growPolygon(hull, count, margin, outline)) return outline;
    return boxOutline(corners, margin);
}

// Whether no corner lies farther beyond the image than rasterizers reach.
TETRALUX_CELL_FUNCTION bool outlineLiesNear(TETRALUX_CELL_IN(OutlineCorners) outline, int width, int height) {
    bool nearby = true;
    for (int i = 0; i < 4; ++i) {
        Pair corner = outline.at[i];
        nearby = nearby && corner.x > wide(-farthestCorner) && corner.y > wide(-farthestCorner) && corner.x < wide(width) + wide(farthestCorner) &&
               corner.y < wide(height) + wide(farthestCorner);
    }
    return nearby;
}

// The pixels [x0, x1) × [y0, y1).
TETRALUX_CELL_FUNCTION OutlineCorners boxOfPixels(int x0, int y0, int x1, int y1) {
    OutlineCorners outline;
    wide toEdge = wide(0.5);
    outline.at[0] = Pair(wide(x0) - toEdge, wide(y0) - toEdge);
    outline.at[1] = Pair(wide(x1) - toEdge, wide(y0) - toEdge);
    outline.at[2] = Pair(wide(x1) - toEdge, wide(y1) - toEdge);
    outline.at[3] = Pair(wide(x0) - toEdge, wide(y1) - toEdge);
    return outline;
}

// What a cell with these corners is drawn as: its hull, or the rectangle of its pixels where it has none because it
// reaches behind the eye or too far beyond the image.
TETRALUX_CELL_FUNCTION OutlineCorners outlineOfCell(const Triple v[4], TETRALUX_CELL_IN(CellView) view, wide margin) {
    if (liesBeforeEye(v, view.orthographic)) {
        OutlineCorners corners;
        for (int k = 0; k < 4; ++k) corners.at[k] = pixelOfPoint(v[k], view);
        OutlineCorners outline = hullOutline(corners, margin);
        if (outlineLiesNear(outline, view.width, view.height)) return outline;
    }
    CellRect rect;
    rect.x0 = rect.y0 = rect.x1 = rect.y1 = 0;
    rectangleOfCell(v, view, rect);
    return boxOfPixels(rect.x0, rect.y0, rect.x1, rect.y1);
}
