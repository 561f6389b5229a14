// SPDX-License-Identifier: Apache-2.0
#include <projection/cpu_transfer.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include <projection/transfer_support.h>

namespace tetralux::projection {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double largestPeakDepth = 1e4;
/// Of a colour's channel, for TransferPiece::fine: then V's error of D³/16 at D = 1/10 changes a piece by 1e-6.
constexpr double largestFineChange = 0.04;

/// The line that piecewise linear nodes follow at `inside`, which is no node, continued to `s`.
template <class Node, class Value>
Value lineAt(const std::vector<Node>& nodes, Value Node::*value, double inside, double s) {
    const auto above = std::upper_bound(nodes.begin(), nodes.end(), inside,
                                        [](double x, const Node& node) { return x < node.scalar; });
    if (above == nodes.begin()) return nodes.front().*value;
    if (above == nodes.end()) return nodes.back().*value;
    const auto below = above - 1;
    const double t = (s - below->scalar) / (above->scalar - below->scalar);
    return (1.0 - t) * ((*below).*value) + t * ((*above).*value);
}

bool sameLine(const TransferPiece& a, const TransferPiece& b) {
    if (!a.visible && !b.visible) return true;
    const bool constant = a.extinctionSlope == 0 && b.extinctionSlope == 0 && a.extinction == b.extinction;
    bool sameColor = true;
    for (int c = 0; c < 3; ++c)
        sameColor = sameColor && a.colorSlope[c] == 0 && b.colorSlope[c] == 0 && a.color[c] == b.color[c];
    return a.visible == b.visible && constant && sameColor;
}

}  // namespace

CpuTransfer::CpuTransfer(const preint::TransferFunction& function) : function_(function) {
    for (const auto& surface : function.isosurfaces) {
        if (!(surface.opacity > 0)) continue;
        const double depth = std::min(-std::log1p(-surface.opacity), largestPeakDepth);
        peaks_.push_back({static_cast<float>(surface.value),
                          static_cast<float>(surface.opacity),
                          static_cast<float>(depth),
                          {static_cast<float>(surface.color.x), static_cast<float>(surface.color.y),
                           static_cast<float>(surface.color.z)}});
    }
    std::vector<double> breaks;
    for (const auto& node : function.color) breaks.push_back(node.scalar);
    for (const auto& node : function.extinction) breaks.push_back(node.scalar);
    for (const auto& surface : function.isosurfaces)
        if (surface.opacity > 0) breaks.push_back(surface.value);
    std::sort(breaks.begin(), breaks.end());
    // neither what float cannot tell apart nor what lies outside the field's range makes a piece
    std::vector<double> kept;
    for (double value : breaks)
        if (value >= 0 && value <= 1 && (kept.empty() || static_cast<float>(value) > static_cast<float>(kept.back())))
            kept.push_back(value);

    double low = -infinity;
    for (double value : kept) {
        addPiece(function, low, value);
        low = value;
    }
    addPiece(function, low, infinity);

    for (auto& piece : pieces_) {
        const auto range =
            std::equal_range(peaks_.begin(), peaks_.end(), TransferPeak{piece.high, 0, 0, {}},
                             [](const TransferPeak& a, const TransferPeak& b) { return a.value < b.value; });
        piece.peakBegin = static_cast<std::uint32_t>(range.first - peaks_.begin());
        piece.peakEnd = static_cast<std::uint32_t>(range.second - peaks_.begin());
    }
    std::vector<TransferPiece> merged;
    for (const auto& piece : pieces_) {
        if (!merged.empty() && merged.back().peakBegin == merged.back().peakEnd && sameLine(merged.back(), piece)) {
            merged.back().high = piece.high;
            merged.back().peakBegin = piece.peakBegin;
            merged.back().peakEnd = piece.peakEnd;
        } else {
            merged.push_back(piece);
        }
    }
    pieces_ = std::move(merged);

    ends_.push_back(-std::numeric_limits<float>::infinity());
    for (std::size_t i = 0; i + 1 < pieces_.size(); ++i) ends_.push_back(pieces_[i].high);
    ends_.push_back(std::numeric_limits<float>::infinity());
    for (std::size_t step = 0; step <= lookUpSteps; ++step) {
        const float s = static_cast<float>(step) / static_cast<float>(lookUpSteps);
        std::uint32_t piece = 0;
        while (piece + 1 < pieces_.size() && pieces_[piece].high <= s) ++piece;
        firstPiece_.push_back(piece);
    }
    const std::optional<glm::dvec3> only = onlyColor(function_);
    constantColor_ = only.has_value();
    color_ = only.value_or(glm::dvec3(0));
}

void CpuTransfer::addPiece(const preint::TransferFunction& function, double low, double high) {
    TransferPiece piece{};
    piece.low = static_cast<float>(low);
    piece.high = static_cast<float>(high);
    // beyond the field's range nothing is asked for
    const double finiteLow = std::isinf(low) ? std::min(0.0, high) : low;
    const double finiteHigh = std::isinf(high) ? std::max(1.0, low) : high;
    double inside = 0.5 * (finiteLow + finiteHigh);
    if (finiteLow == finiteHigh) inside = std::isinf(low) ? high - 1.0 : low + 1.0;
    // the float between the ends about which the line is given
    const double middle = static_cast<float>(0.5 * (finiteLow + finiteHigh));
    const double width = finiteHigh - finiteLow;
    piece.middle = static_cast<float>(middle);
    auto line = [&](auto valueAt, float& value, float& slope) {
        const double atLow = valueAt(finiteLow), atHigh = valueAt(finiteHigh);
        slope = width > 0 ? static_cast<float>((atHigh - atLow) / width) : 0.0f;
        value = static_cast<float>(width > 0 ? atLow + (middle - finiteLow) / width * (atHigh - atLow) : atLow);
    };
    if (!function.extinction.empty()) {
        auto extinction = [&](double s) {
            return lineAt(function.extinction, &preint::ExtinctionNode::extinction, inside, s);
        };
        line(extinction, piece.extinction, piece.extinctionSlope);
        piece.visible = piece.extinction > 0 || piece.extinctionSlope != 0;
    }
    for (int c = 0; c < 3; ++c)
        line([&](double s) { return lineAt(function.color, &preint::ColorNode::color, inside, s)[c]; }, piece.color[c],
             piece.colorSlope[c]);
    piece.fine = true;
    for (float slope : piece.colorSlope) piece.fine = piece.fine && std::abs(slope) * width <= largestFineChange;
    pieces_.push_back(piece);
}

}  // namespace tetralux::projection
