// SPDX-License-Identifier: Apache-2.0
//
// Maps a key (larger = nearer) to a number from 0 to 2³² − 1 that ascends from near to far, spread over [nearest, farthest]. One text for C++
// (power_order.cpp) and GLSL.
TETRALUX_CELL_FUNCTION wide orderPosition(wide key, wide nearest, wide farthest) {
    wide range = nearest - farthest;
    wide position = range > wide(0.0) ? (nearest - key) / range : wide(0.0);
    return min(max(position, wide(0.0)), wide(1.0)) * wide(4294967295.0);
}
