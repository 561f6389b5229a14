// SPDX-License-Identifier: Apache-2.0
/// \file
/// Anti-aliasing: a pixel is the mean of several rays through a regular grid within it (box filter), each of which sees
/// what the picture is of a point: isosurfaces, outlines, limits, opaque surfaces. Means are of linear premultiplied
/// RGBA. The grid is that of the pixels of a picture n times as large each way, so cells are projected, put in order
/// and set up once for all samples.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include <projection/core/engine.h>

namespace tetralux::projection {

/// n: the smallest whole number whose square is at least `samples`.
int samplesPerAxis(int samples);

/// The view of all samples: n·n pixels in the place of each.
Camera sampledCamera(const Camera& camera, int perAxis);

/// The scene of which a picture with `scene`'s samples is the mean: what is told in pixels is in samples.
Scene sceneOfSamples(const Scene& scene);

/// `engine`, made of sceneOfSamples(scene), with its pictures averaged. FrameReport's pixels repaired and wrong, and
/// its maps, are of samples. Returns `engine` itself where a pixel has one.
std::unique_ptr<Engine> withSamples(std::unique_ptr<Engine> engine, const Scene& scene);

/// Pixels (y·width + x, ascending) of a scene by the reference, whatever its settings say, with what lies behind, into
/// `image` of the camera's size. `maps`: those of the frame (FrameReport::maps), or nullptr.
void castPixels(const Scene& scene, const Camera& camera, const PixelMaps* maps,
                const std::vector<std::uint32_t>& pixels, Image& image);

}  // namespace tetralux::projection
