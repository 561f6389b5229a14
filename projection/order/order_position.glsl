// SPDX-License-Identifier: Apache-2.0
//
// Maps a key (larger = nearer) to a number from 0 to 2³² − 1 that ascends from near to far, spread over [nearest,
// farthest]. One text for C++ (power_order.cpp) and GLSL.
TETRALUX_CELL_FUNCTION wide orderPosition(wide key, wide nearest, wide farthest) {
    wide range = nearest - farthest;
    wide position = range > wide(0.0) ? (nearest - key) / range : wide(0.0);
    // 2³² − 1 as a product: GLSL's literals are floats, the nearest of which is 2³²
    return min(max(position, wide(0.0)), wide(1.0)) * (wide(65535.0) * wide(65537.0));
}
