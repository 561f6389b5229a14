// SPDX-License-Identifier: Apache-2.0
#include <projection/cpu/cpu_transfer.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <projection/core/transfer_support.h>

namespace tetralux::projection {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
/// So many nodes are walked along as they are; a run is no longer than that.
constexpr std::size_t fewNodes = 64, longestRun = 64;
constexpr double largestIsosurfaceDepth = 1e4;
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

/// A scalar below the end `s` of the field's range, or above it, and no farther than the next node.
double besideEnd(const preint::TransferFunction& function, double s, bool below) {
    double next = below ? s - 1.0 : s + 1.0;
    const auto meet = [&](double node) {
        if (below ? node < s : node > s) next = below ? std::max(next, node) : std::min(next, node);
    };
    for (const auto& node : function.color) meet(node.scalar);
    for (const auto& node : function.extinction) meet(node.scalar);
    return 0.5 * (s + next);
}

bool isFine(const TransferPiece& piece, double width) {
    return std::all_of(std::begin(piece.colorSlope), std::end(piece.colorSlope),
                       [&](float slope) { return std::abs(slope) * width <= largestFineChange; });
}

bool sameLine(const TransferPiece& a, const TransferPiece& b) {
    if (!a.visible && !b.visible) return true;
    const bool constant = a.extinctionSlope == 0 && b.extinctionSlope == 0 && a.extinction == b.extinction;
    bool sameColor = true;
    for (int c = 0; c < 3; ++c)
        sameColor = sameColor && a.colorSlope[c] == 0 && b.colorSlope[c] == 0 && a.color[c] == b.color[c];
    return a.visible == b.visible && constant && sameColor;
}

/// The line of the nodes' mean slope that has their mean, as values at `middle`; false if a node is farther from it
/// than the tolerance.
struct RunLine {
    double middle, value[4], slope[4];

    RunLine(const std::vector<TransferNode>& nodes, std::size_t begin, std::size_t end) {
        const double width = nodes[end].scalar - nodes[begin].scalar;
        middle = 0.5 * (nodes[begin].scalar + nodes[end].scalar);
        for (std::size_t c = 0; c < 4; ++c) {
            double sum = 0;
            for (std::size_t i = begin; i < end; ++i)
                sum += 0.5 * (nodes[i].value[c] + nodes[i + 1].value[c]) * (nodes[i + 1].scalar - nodes[i].scalar);
            value[c] = sum / width;
            slope[c] = (nodes[end].value[c] - nodes[begin].value[c]) / width;
        }
    }

    bool meets(const TransferNode& node, double tolerance) const {
        for (std::size_t c = 0; c < 4; ++c) {
            const double bound = c == 3 ? tolerance * node.value[c] : tolerance;
            if (!(std::abs(value[c] + slope[c] * (node.scalar - middle) - node.value[c]) <= bound)) return false;
        }
        return true;
    }
};

/// The end at which extinction is less, as float holds it. About it a line of extinction is a sum of positive numbers,
/// none of which is lost beside a larger one: depth keeps its relative precision at the foot of the steepest ramp.
double leastEnd(const std::array<double, 2>& ends, const std::array<double, 2>& extinctions) {
    return static_cast<double>(static_cast<float>(extinctions[0] <= extinctions[1] ? ends[0] : ends[1]));
}

/// The last node of the longest run from `begin` that one line meets.
std::size_t runEnd(const std::vector<TransferNode>& nodes, std::size_t begin, double tolerance) {
    std::size_t end = begin + 1;
    while (end + 1 < nodes.size() && end - begin < longestRun && !nodes[end].ends) {
        const RunLine line(nodes, begin, end + 1);
        for (std::size_t i = begin; i <= end + 1; ++i)
            if (!line.meets(nodes[i], tolerance)) return end;
        ++end;
    }
    return end;
}

std::vector<TransferNode> nodesAt(const preint::TransferFunction& function, const std::vector<double>& scalars) {
    const auto isNode = [](const auto& list, double s) {
        return std::count_if(list.begin(), list.end(), [&](const auto& node) { return node.scalar == s; });
    };
    std::vector<TransferNode> nodes;
    for (const double s : scalars) {
        const glm::dvec3 color = function.colorAt(s);
        nodes.push_back({s, {color.x, color.y, color.z, function.extinctionAt(s)}, false});
        nodes.back().ends = isNode(function.color, s) > 1 || isNode(function.extinction, s) > 1 ||
                            std::any_of(function.isosurfaces.begin(), function.isosurfaces.end(),
                                        [&](const auto& surface) { return surface.value == s; });
    }
    return nodes;
}

}  // namespace

CpuTransfer::CpuTransfer(const preint::TransferFunction& function, double tolerance) : function_(function) {
    for (const auto& surface : function.isosurfaces) {
        if (!(surface.opacity > 0)) continue;
        const double depth = std::min(-std::log1p(-surface.opacity), largestIsosurfaceDepth);
        isosurfaces_.push_back({static_cast<float>(surface.value),
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

    const std::vector<TransferNode> nodes = nodesAt(function, kept);
    double low = -infinity;
    for (std::size_t i = 0; i < kept.size();) {
        std::size_t end = i;
        if (i > 0 && tolerance > 0 && kept.size() > fewNodes) end = runEnd(nodes, i - 1, tolerance);
        if (end > i)
            addRun(nodes, i - 1, end);
        else
            addPiece(function, low, kept[end]);
        low = kept[end];
        i = end + 1;
    }
    addPiece(function, low, infinity);

    for (auto& piece : pieces_) {
        const auto range = std::equal_range(
            isosurfaces_.begin(), isosurfaces_.end(), TransferIsosurface{piece.high, 0, 0, {}},
            [](const TransferIsosurface& a, const TransferIsosurface& b) { return a.value < b.value; });
        piece.isosurfaceBegin = static_cast<std::uint32_t>(range.first - isosurfaces_.begin());
        piece.isosurfaceEnd = static_cast<std::uint32_t>(range.second - isosurfaces_.begin());
    }
    std::vector<TransferPiece> merged;
    for (const auto& piece : pieces_) {
        if (!merged.empty() && merged.back().isosurfaceBegin == merged.back().isosurfaceEnd &&
            sameLine(merged.back(), piece)) {
            merged.back().high = piece.high;
            merged.back().isosurfaceBegin = piece.isosurfaceBegin;
            merged.back().isosurfaceEnd = piece.isosurfaceEnd;
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
    const double inside =
        finiteLow < finiteHigh ? 0.5 * (finiteLow + finiteHigh) : besideEnd(function, finiteLow, std::isinf(low));
    const double width = finiteHigh - finiteLow;
    const auto extinction = [&](double s) {
        return function.extinction.empty()
                   ? 0.0
                   : lineAt(function.extinction, &preint::ExtinctionNode::extinction, inside, s);
    };
    const double origin = leastEnd({finiteLow, finiteHigh}, {extinction(finiteLow), extinction(finiteHigh)});
    piece.origin = static_cast<float>(origin);
    auto line = [&](auto valueAt, float& value, float& slope) {
        const double atLow = valueAt(finiteLow), atHigh = valueAt(finiteHigh);
        const double t = width > 0 ? (origin - finiteLow) / width : 0.0;
        slope = width > 0 ? static_cast<float>((atHigh - atLow) / width) : 0.0f;
        value = static_cast<float>((1.0 - t) * atLow + t * atHigh);
    };
    if (!function.extinction.empty()) {
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

void CpuTransfer::addRun(const std::vector<TransferNode>& nodes, std::size_t begin, std::size_t end) {
    const RunLine line(nodes, begin, end);
    TransferPiece piece{};
    piece.low = static_cast<float>(nodes[begin].scalar);
    piece.high = static_cast<float>(nodes[end].scalar);
    const std::array<double, 2> ends{nodes[begin].scalar, nodes[end].scalar};
    piece.origin = static_cast<float>(leastEnd(ends, {nodes[begin].value[3], nodes[end].value[3]}));
    const auto valueOf = [&](std::size_t c) {
        return static_cast<float>(line.value[c] + line.slope[c] * (piece.origin - line.middle));
    };
    for (std::size_t c = 0; c < 3; ++c) {
        piece.color[c] = valueOf(c);
        piece.colorSlope[c] = static_cast<float>(line.slope[c]);
    }
    piece.extinction = valueOf(3);
    piece.extinctionSlope = static_cast<float>(line.slope[3]);
    piece.visible = piece.extinction > 0 || piece.extinctionSlope != 0;
    piece.fine = isFine(piece, nodes[end].scalar - nodes[begin].scalar);
    pieces_.push_back(piece);
}

}  // namespace tetralux::projection
