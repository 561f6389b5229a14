// SPDX-License-Identifier: Apache-2.0
//
// What the fragment texts are compiled for: TETRALUX_MODE is one of the numbers below, the rest 0 or 1 unless said
// otherwise.
//
//   TETRALUX_ORTHOGRAPHIC, TETRALUX_DISCONTINUITIES (how many), TETRALUX_SUPPORTS (how many), TETRALUX_LIGHTS (how many), TETRALUX_SILHOUETTE,
//   TETRALUX_APPROXIMATE_SILHOUETTE, TETRALUX_GRADIENT_OPACITY, TETRALUX_GRADIENT (whether anything reads the cell's gradient),
//   TETRALUX_LENGTH (whether anything reads the segment's length)
//   TETRALUX_FULL_LIGHT       anything but the plain lights of shading/cell_shading.glsl; TETRALUX_ATTRIBUTES: vertices have some
//   TETRALUX_SMOOTH_SILHOUETTE, TETRALUX_SURFACE_SHADOWS: the smoothed gradient's silhouettes; cells have rows of shadows of their own
//   TETRALUX_DATA_SPACE       extinction is integrated over the scalar's variation
//   TETRALUX_SCALE_INVARIANT  the table is a 2D one of that integral; without it a 3D one is looked up with the path as its length
//   TETRALUX_SAMPLED          post-classification, pre-classification where TETRALUX_SAMPLE_AT ≥ 0; TETRALUX_LINEAR_OPACITY: linear form
//   TETRALUX_PER_CELL         each segment that shows is one contribution (ContributionWeights::perCell in projection/modes.h)
//   TETRALUX_DEPTH_COLOR      colours go over into another one with the distance (shading/lights.h)
//   TETRALUX_LIMITS           the view has pixel maps; TETRALUX_CUT_LAYERS: light falls on the layers of their cuts
//   TETRALUX_TILES            compute tiles (gl_tile_draw.comp), else fragments
#define TETRALUX_MODE_VOLUME 0
#define TETRALUX_MODE_MIP 1
#define TETRALUX_MODE_AVERAGE 2
#define TETRALUX_MODE_FIRST_HIT 3
#define TETRALUX_MODE_MINIMUM 4
#define TETRALUX_MODE_ADDITIVE 5
#define TETRALUX_MODE_ABSORPTION 6
#define TETRALUX_MODE_DEPTH 7

// What is the same for all pixels of a cell.
#if TETRALUX_TILES
#define TETRALUX_OF_CELL
#else
#define TETRALUX_OF_CELL flat in
#endif
#if TETRALUX_GRADIENT
TETRALUX_OF_CELL vec4 gradient;  // unit normal, magnitude in scene units
#endif

#if TETRALUX_LIMITS
float isosurfaceScale = 1.0;  // of the pixel: factor of extinction
#else
const float isosurfaceScale = 1.0;
#endif
#define TETRALUX_ISOSURFACE_SCALE isosurfaceScale
