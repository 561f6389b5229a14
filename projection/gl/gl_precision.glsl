// SPDX-License-Identifier: Apache-2.0 In shaders what varies per pixel and what is the same for a whole cell are both
// float (projection/cells/cell_interval.glsl).
#define cell_real float
