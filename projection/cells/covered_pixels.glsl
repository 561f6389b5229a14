// SPDX-License-Identifier: Apache-2.0
//
// Where a cell lies in the image, one text for C++ (cell_setup.cpp) and GLSL. After projected_cell.glsl; Pair is two
// `wide` (dvec2).

// Reasons of SkipReason (cell_setup.h), as numbers.
const int skipNone = 0, skipOutsideView = 1, skipNoPixelCentre = 2;

// What of a frame these functions read: pixel of the optical axis among the samples, and the image's size.
struct CellView {
    Pair centre;
    int width, height;
    bool orthographic;
    wide depthOrigin;  // CameraFrame::depthOrigin
};

// Pixels [x0, x1) × [y0, y1).
struct CellRect {
    int x0, y0, x1, y1;
};

TETRALUX_CELL_FUNCTION Pair pixelOfPoint(TETRALUX_CELL_IN(Triple) p, TETRALUX_CELL_IN(CellView) view) {
    if (view.orthographic) return Pair(view.centre.x + p.x, view.centre.y + p.y);
    return Pair(view.centre.x + p.x / p.z, view.centre.y + p.y / p.z);
}

struct PixelBounds {
    Pair low, high;
};

TETRALUX_CELL_FUNCTION void includePoint(TETRALUX_CELL_IN(Triple) p, TETRALUX_CELL_IN(CellView) view, TETRALUX_CELL_INOUT(PixelBounds) bounds) {
    Pair pixel = pixelOfPoint(p, view);
    bounds.low = Pair(min(bounds.low.x, pixel.x), min(bounds.low.y, pixel.y));
    bounds.high = Pair(max(bounds.high.x, pixel.x), max(bounds.high.y, pixel.y));
}

// The first whole number from `low` on, of 0 to `limit`, and the first beyond `high`. Rounding down is converting:
// there are no negative pixels, and floor() of doubles goes wrong in some places of Mesa 22.3.
TETRALUX_CELL_FUNCTION int firstPixel(wide low, int limit) {
    wide within = min(max(low, wide(0.0)), wide(limit));
    int whole = int(within);
    return wide(whole) < within ? whole + 1 : whole;
}
TETRALUX_CELL_FUNCTION int endPixel(wide high, int limit) {
    int whole = int(min(max(high, wide(0.0)), wide(limit)));
    return min(whole + 1, limit);
}

// The pixels whose samples a cell with these corners may cover, and why it is skipped where there are none.
TETRALUX_CELL_FUNCTION int rectangleOfCell(const Triple v[4], TETRALUX_CELL_IN(CellView) view, TETRALUX_CELL_INOUT(CellRect) rect) {
    wide deepest = max(max(v[0].z, v[1].z), max(v[2].z, v[3].z));
    wide nearest = min(min(v[0].z, v[1].z), min(v[2].z, v[3].z));
    if (!(deepest > wide(0.0))) return skipOutsideView;
    wide clip = view.orthographic ? nearest : wide(nearestDepthShare) * deepest;
    PixelBounds bounds;
    bounds.low = Pair(wide(unboundedPixel), wide(unboundedPixel));
    bounds.high = Pair(-bounds.low.x, -bounds.low.y);
    for (int k = 0; k < 4; ++k) {
        if (v[k].z >= clip) {
            includePoint(v[k], view, bounds);
        } else {
            for (int j = 0; j < 4; ++j) {  // where the edge from behind comes to the front
                if (v[j].z > clip) {
                    wide share = (clip - v[k].z) / (v[j].z - v[k].z);
                    includePoint((wide(1.0) - share) * v[k] + share * v[j], view, bounds);
                }
            }
        }
    }
    Pair low = bounds.low, high = bounds.high;
    if (!(high.x >= wide(0.0) && high.y >= wide(0.0) && low.x <= wide(view.width - 1) && low.y <= wide(view.height - 1))) return skipOutsideView;
    rect.x0 = firstPixel(low.x, view.width);
    rect.y0 = firstPixel(low.y, view.height);
    rect.x1 = endPixel(high.x, view.width);
    rect.y1 = endPixel(high.y, view.height);
    return rect.x0 >= rect.x1 || rect.y0 >= rect.y1 ? skipNoPixelCentre : skipNone;
}

// Whether all corners have pixels, which is what a hull is made of.
TETRALUX_CELL_FUNCTION bool liesBeforeEye(const Triple v[4], bool orthographic) {
    if (orthographic) return true;
    wide deepest = max(max(v[0].z, v[1].z), max(v[2].z, v[3].z));
    wide nearest = min(min(v[0].z, v[1].z), min(v[2].z, v[3].z));
    return deepest > wide(0.0) && nearest >= wide(nearestDepthShare) * deepest;
}

// What a record refers to: the centroid of a cell well before the eye, else a point of its rectangle at half its
// largest depth.
TETRALUX_CELL_FUNCTION CellReference referenceOfCell(TETRALUX_CELL_IN(CellForms) forms, const Triple v[4], TETRALUX_CELL_IN(CellView) view) {
    wide deepest = max(max(v[0].z, v[1].z), max(v[2].z, v[3].z));
    wide nearest = min(min(v[0].z, v[1].z), min(v[2].z, v[3].z));
    if (view.orthographic || nearest > wide(centroidDepthShare) * deepest) return centroidReference(forms, view.orthographic);
    CellRect rect;
    rect.x0 = rect.y0 = rect.x1 = rect.y1 = 0;
    rectangleOfCell(v, view, rect);
    CellReference reference;
    reference.imageX = wide(0.5) * wide(rect.x0 + rect.x1) - view.centre.x;
    reference.imageY = wide(0.5) * wide(rect.y0 + rect.y1) - view.centre.y;
    reference.depth = wide(0.5) * deepest;
    reference.perDepth = wide(1.0) / reference.depth;
    coordinatesAt(forms, reference);
    return reference;
}

// Value `i` of CellRecord (cell_setup.h) from 12 on; 0 to 11 are the planes, by the cell's own numbering of its
// corners.
TETRALUX_CELL_FUNCTION wide recordValue(int i, TETRALUX_CELL_IN(ProjectedCell) cell, TETRALUX_CELL_IN(CellReference) reference, const wide s[4], int frontMask,
                                        TETRALUX_CELL_IN(CellView) view) {
    Pair pixel = Pair(view.centre.x + reference.imageX, view.centre.y + reference.imageY);
    Pair whole = Pair(round(pixel.x), round(pixel.y));
    switch (i) {
        case 12: return wide(frontMask);
        case 13: return whole.x;
        case 14: return whole.y;
        case 15: return pixel.x - whole.x;
        case 16: return pixel.y - whole.y;
        case 17: return cell.scalar;
        case 18: return cell.scalarPerX;
        case 19: return cell.scalarPerY;
        case 20: return cell.scalarPerInverseDepth;
        case 21: return min(min(s[0], s[1]), min(s[2], s[3]));
        case 22: return max(max(s[0], s[1]), max(s[2], s[3]));
        default: return reference.depth - view.depthOrigin;
    }
}
