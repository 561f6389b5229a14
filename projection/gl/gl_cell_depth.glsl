// SPDX-License-Identifier: Apache-2.0
//
// Depths along rays from a point near the mesh. After gl_cell_record.glsl and projection/cells/cell_interval.glsl.
uniform float depthReference;  // of inverse depth, and what distances are measured from (projection/order/ray_inverse_depth.h)

// z_c less depthReference.
float beyondReference(CellRecord cell) { return cell.fromOrigin - (depthReference - depthOrigin); }

// How much deeper than depthReference the ray is at inverseDepth: in differences, which hold it however far the eye is.
float depthBeyond(CellRecord cell, float inverseDepth) {
#if TETRALUX_ORTHOGRAPHIC
    return beyondReference(cell) - abs(cell.scale) * inverseDepth;
#else
    return beyondReference(cell) - cell.scale * (inverseDepth * depthRatio(inverseDepth));
#endif
}
