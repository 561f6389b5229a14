// SPDX-License-Identifier: Apache-2.0
/// \file
/// Isolines of a slice as lines of a constant width in pixels, with rims as soft as a pixel is wide.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/vec2.hpp>

#include <mesh/tet/isolines.h>
#include <projection/core/camera.h>

namespace tetralux::projection {

/// What a line covers of a pixel.
struct LineCover {
    float share = 0.0f;       ///< 0 to 1
    std::uint32_t value = 0;  ///< whose line it is
};

/// One camera's view of a slice's isolines. A slice is flat, so that no part of it hides another: the distance d in the
/// image from a pixel's centre to the nearest line is all that counts. A line of width w covers as much of the pixel as
/// of the interval from −1/2 to 1/2 lies between d − w/2 and d + w/2.
class IsolinePixels {
public:
    /// `width` in pixels; tiles of `tileSize`² pixels, row by row from the top left.
    IsolinePixels(const CameraFrame& frame, const std::vector<mesh::IsolineSegment>& segments, double width,
                  int tileSize);

    /// tileSize² pixels, row by row; empty where no line comes near.
    std::vector<LineCover> inTile(std::size_t tile) const;

private:
    struct Segment {
        glm::dvec2 from, to;  // pixels
        std::uint32_t value;
    };
    void bin();

    double width_;  // pixels
    int tileSize_;
    std::size_t tilesAcross_;
    glm::ivec2 size_;  // of the image
    std::vector<Segment> segments_;
    std::vector<std::vector<std::uint32_t>> tiles_;  // segments that come near
};

}  // namespace tetralux::projection
