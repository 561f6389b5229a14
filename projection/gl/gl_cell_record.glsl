// SPDX-License-Identifier: Apache-2.0
//
// CellRecord of projection/cells/cell_setup.h as a shader sees it: 24 floats in six vec4, in the order of that
// struct. A test writes every field by the one and reads it by the other.
#define TETRALUX_RECORD_VECTORS 6

struct CellRecord {
    vec3 plane[4];
    int frontMask;
    vec2 pixel, fraction;
    float scalar, scalarPerX, scalarPerY, scalarPerInverseDepth, scalarLow, scalarHigh;
    float scale;        // z_c
    float fromOrigin;  // z_c less depthOrigin, which is 0 or far from the eye near the mesh
};

uniform float depthOrigin;

CellRecord unpackRecord(vec4 v0, vec4 v1, vec4 v2, vec4 v3, vec4 v4, vec4 v5) {
    CellRecord cell;
    cell.plane[0] = v0.xyz;
    cell.plane[1] = vec3(v0.w, v1.xy);
    cell.plane[2] = vec3(v1.zw, v2.x);
    cell.plane[3] = v2.yzw;
    cell.frontMask = int(v3.x);
    cell.pixel = v3.yz;
    cell.fraction = vec2(v3.w, v4.x);
    cell.scalar = v4.y;
    cell.scalarPerX = v4.z;
    cell.scalarPerY = v4.w;
    cell.scalarPerInverseDepth = v5.x;
    cell.scalarLow = v5.y;
    cell.scalarHigh = v5.z;
    cell.fromOrigin = v5.w;
    cell.scale = depthOrigin + v5.w;
    return cell;
}
