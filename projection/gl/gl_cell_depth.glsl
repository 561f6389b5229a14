// SPDX-License-Identifier: Apache-2.0
//
// Depths along rays from a point near the mesh. After gl_cell_record.glsl and projection/cells/cell_interval.glsl.
uniform float depthReference;  // of nearness, and what distances are measured from (projection/order/ray_nearness.h)

// z_c less depthReference.
float beyondReference(CellRecord cell) { return cell.fromOrigin - (depthReference - depthOrigin); }

// How much deeper than depthReference the ray is at rho: in differences, which hold it however far the eye is.
float depthBeyond(CellRecord cell, float rho) {
#if TETRALUX_ORTHOGRAPHIC
    return beyondReference(cell) - abs(cell.scale) * rho;
#else
    return beyondReference(cell) - cell.scale * (rho * depthRatio(rho));
#endif
}
