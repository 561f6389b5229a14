// SPDX-License-Identifier: Apache-2.0
/// \file
/// What the tile kernels gather per pixel, and the picture that it makes; the same for every instruction set.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <projection/cpu/cpu_tile.h>

namespace tetralux::projection {

constexpr int columnWidth = 4;
constexpr int columns = cpuTileSize / columnWidth;
constexpr int paddedRows = cpuTileSize + 4;  // a block may begin in the last row
constexpr std::size_t tilePixels = static_cast<std::size_t>(columns) * paddedRows * columnWidth;

/// Of a pixel, counted from the tile's first.
inline std::size_t placeInTile(int x, int y) {
    return static_cast<std::size_t>(((x / columnWidth) * paddedRows + y) * columnWidth + x % columnWidth);
}

/// Accumulators of a tile. What they hold depends on the kind:
///
/// - Composite, Shaded: premultiplied colour r g b, transmittance t, inverse depth `last` at which the last segment
/// ended,
///   and its scalar
/// - FirstHit: colour of the hit, t = 1 until then
/// - Absorption: depth in t
/// - Mip, Minimum: largest or smallest scalar in t
/// - Average: Σ scalar·length in r, Σ length in t
/// - Additive: colour r g b and depth t, summed
/// - Depth: distance beyond TileFrame::depthReference in r, t = 1 until then
struct TileBuffers {
    alignas(64) float r[tilePixels], g[tilePixels], b[tilePixels], t[tilePixels], last[tilePixels],
        lastScalar[tilePixels], rayLength[tilePixels],
        inverseLength[tilePixels];  // the last where variants need it
};

/// Faces of a cell, those that bound inverseDepth from above first.
struct FaceOrder {
    int face[4], fronts;
};
constexpr std::array<FaceOrder, 16> makeFaceOrders() {
    std::array<FaceOrder, 16> orders{};
    for (unsigned fronts = 0; fronts < 16; ++fronts) {
        FaceOrder& order = orders[fronts];
        int backs = 4;
        for (unsigned k = 0; k < 4; ++k) {
            if (fronts >> k & 1u)
                order.face[order.fronts++] = static_cast<int>(k);
            else
                order.face[--backs] = static_cast<int>(k);
        }
    }
    return orders;
}
constexpr std::array<FaceOrder, 16> faceOrders = makeFaceOrders();

constexpr float unset = -1e30f;      // no scalar yet
constexpr float nothingYet = 3e38f;  // inverse depth before the first segment
constexpr float uncertain = -3e38f;  // every later segment is nearer: once out of order, a pixel stays so
constexpr float absorbed = 13.8f;    // −ln(leastTransmittance)

template <TileKind Kind>
constexpr bool gathersScalar = Kind == TileKind::Mip || Kind == TileKind::Minimum || Kind == TileKind::Average;

/// The largest, smallest or mean scalar of the pixel at place `i`; nothing where no cell was met.
template <TileKind Kind>
std::optional<float> gatheredScalar(const TileBuffers& px, std::size_t i) {
    const bool extreme = Kind == TileKind::Mip || Kind == TileKind::Minimum;
    if (!(extreme ? std::abs(px.t[i]) < -unset : px.t[i] > 0)) return std::nullopt;
    return extreme ? px.t[i] : px.r[i] / px.t[i];
}

/// The colour of the pixel at place `i` of the buffers, once its cells are drawn.
template <TileKind Kind>
glm::vec4 finishedPixel(const TileFrame& frame, const TileBuffers& px, std::size_t i) {
    if constexpr (Kind == TileKind::FirstHit) {
        return px.t[i] == 0 ? glm::vec4(px.r[i], px.g[i], px.b[i], 1.0f) : glm::vec4(0.0f);
    } else if constexpr (Kind == TileKind::Composite || Kind == TileKind::Shaded) {
        return glm::vec4{px.r[i], px.g[i], px.b[i], 1.0f - px.t[i]};
    } else if constexpr (Kind == TileKind::Absorption) {
        const float opacity = -std::expm1(-px.t[i]);
        return glm::vec4{frame.constantColor.x * opacity, frame.constantColor.y * opacity,
                         frame.constantColor.z * opacity, opacity};
    } else if constexpr (Kind == TileKind::Additive) {
        const float sum = frame.contributions.sums ? px.t[i] : std::min(px.t[i], 1.0f);
        return glm::vec4{px.r[i], px.g[i], px.b[i], frame.emissionOnly ? 0.0f : sum};
    } else if constexpr (Kind == TileKind::Depth) {
        const double grey = frame.greyOfReference + frame.greyPerDistance * static_cast<double>(px.r[i]);
        return px.t[i] == 0 ? glm::vec4(glm::vec3(static_cast<float>(grey)), 1.0f) : glm::vec4(0.0f);
    } else {
        const std::optional<float> scalar = gatheredScalar<Kind>(px, i);
        return scalar ? glm::vec4(glm::vec3(frame.scalarColors->at(*scalar)), 1.0f) : glm::vec4(0.0f);
    }
}

/// Writes the tile's pixels, and tells which of them are uncertain: drawn out of order if that was `checked`, or of a
/// scalar next to which the colour is another.
template <TileKind Kind>
void resolveTile(const TileFrame& frame, const TileBuffers& px, int x0, int y0, bool checked, Image& image,
                 TileResult& result) {
    const int width = std::min(cpuTileSize, frame.width - x0), height = std::min(cpuTileSize, frame.height - y0);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const std::size_t i = placeInTile(x, y);
            image.at(x0 + x, y0 + y) = finishedPixel<Kind>(frame, px, i);
            bool isUncertainPixel = checked && px.last[i] == uncertain;
            if constexpr (gathersScalar<Kind>) {
                const std::optional<float> scalar = gatheredScalar<Kind>(px, i);
                isUncertainPixel = scalar && frame.scalarColors->isUncertain(*scalar);
            }
            if (isUncertainPixel)
                result.uncertainPixels.push_back(static_cast<std::uint32_t>(y0 + y) *
                                                     static_cast<std::uint32_t>(frame.width) +
                                                 static_cast<std::uint32_t>(x0 + x));
        }
}

}  // namespace tetralux::projection
