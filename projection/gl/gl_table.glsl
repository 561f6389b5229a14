// SPDX-License-Identifier: Apache-2.0
//
// What preint/table_lookup.glsl asks for: the table as a texture, and how it is filtered. What is fixed for a scene
// is a constant here, so that the compiler folds it into its neighbours.
const float tableSize = TETRALUX_TABLE_SIZE;
const float tableSlices = TETRALUX_TABLE_SLICES;
const float tableLengthMax = TETRALUX_TABLE_LENGTH_MAX;
const float tableLengthScale = TETRALUX_TABLE_LENGTH_SCALE;
#if TETRALUX_DISCONTINUITIES
uniform vec2 tableZone[TETRALUX_ZONES];
uniform float discontinuityValue[TETRALUX_DISCONTINUITIES];  // see preint/gather_segment.glsl
uniform vec4 discontinuityLayer[TETRALUX_DISCONTINUITIES];
uniform int zoneAfter[TETRALUX_DISCONTINUITIES + 1];
#else
const vec2 tableZone[1] = vec2[1](vec2(TETRALUX_ZONE_LOW, TETRALUX_ZONE_PER_SCALAR));
#endif

#if TETRALUX_WARPS
const vec2 tableWarp[TETRALUX_WARPS] = vec2[TETRALUX_WARPS](TETRALUX_WARP_VALUES);
#endif
#if TETRALUX_RAMPS
const vec3 tableRamp[TETRALUX_RAMPS] = vec3[TETRALUX_RAMPS](TETRALUX_RAMP_VALUES);
#endif

const float tableRows = tableSize * float(TETRALUX_ZONES);

#if TETRALUX_LINEAR_SAMPLER
// The sampler interpolates with weights of float precision (projection/gl/gl_sampler_probe.h has measured it).
#if TETRALUX_SCALE_INVARIANT
uniform sampler2D tableTexels;
vec4 tableTexel(float u, float v, float w) {
    return textureLod(tableTexels, vec2(u * (1.0 / tableSize), v * (1.0 / tableRows)), 0.0);
}
#else
uniform sampler3D tableTexels;
vec4 tableTexel(float u, float v, float w) {
    return textureLod(tableTexels, vec3(u * (1.0 / tableSize), v * (1.0 / tableRows), w * (1.0 / tableSlices)), 0.0);
}
#endif

#else
// Samplers of many devices have weights of 8 bits: too coarse for a table whose neighbouring texels differ by some
// 1e-2.
struct TexelPair {
    int low, high;
    float weight;  // of high
};
TexelPair texelPair(float coordinate, float size) {
    float shifted = clamp(coordinate - 0.5, 0.0, size - 1.0);
    float low = floor(shifted);
    return TexelPair(int(low), int(min(low + 1.0, size - 1.0)), shifted - low);
}
#if TETRALUX_SCALE_INVARIANT
uniform sampler2D tableTexels;
vec4 tableTexel(float u, float v, float w) {
    TexelPair x = texelPair(u, tableSize), y = texelPair(v, tableRows);
    return mix(mix(texelFetch(tableTexels, ivec2(x.low, y.low), 0), texelFetch(tableTexels, ivec2(x.high, y.low), 0), x.weight),
               mix(texelFetch(tableTexels, ivec2(x.low, y.high), 0), texelFetch(tableTexels, ivec2(x.high, y.high), 0), x.weight),
               y.weight);
}
#else
uniform sampler3D tableTexels;
vec4 tableSlice(TexelPair x, TexelPair y, int z) {
    return mix(mix(texelFetch(tableTexels, ivec3(x.low, y.low, z), 0), texelFetch(tableTexels, ivec3(x.high, y.low, z), 0), x.weight),
               mix(texelFetch(tableTexels, ivec3(x.low, y.high, z), 0), texelFetch(tableTexels, ivec3(x.high, y.high, z), 0), x.weight),
               y.weight);
}
vec4 tableTexel(float u, float v, float w) {
    TexelPair x = texelPair(u, tableSize), y = texelPair(v, tableRows), z = texelPair(w, tableSlices);
    return mix(tableSlice(x, y, z.low), tableSlice(x, y, z.high), z.weight);
}
#endif
#endif
