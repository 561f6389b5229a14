// SPDX-License-Identifier: Apache-2.0
#include <preint/exact_integral.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace tetralux::preint {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// What light has met so far, and what the next part adds behind it.
void composite(SegmentResult& sum, const SegmentResult& behind) {
    sum.color += std::exp(-sum.opticalDepth) * behind.color;
    sum.opticalDepth += behind.opticalDepth;
}

void compositeIsosurface(SegmentResult& sum, const Isosurface& surface) {
    sum.color += std::exp(-sum.opticalDepth) * surface.opacity * surface.color;
    sum.opticalDepth += -std::log1p(-surface.opacity);  // opacity 1: infinite
}

/// Value of piecewise linear `nodes` at `scalar`, which is an end of the interval (low, high) that holds no node
/// inside.
template <class Node, class Value>
Value valueFromInside(const std::vector<Node>& nodes, Value Node::*value, double low, double scalar) {
    const auto above =
        std::upper_bound(nodes.begin(), nodes.end(), low, [](double s, const Node& node) { return s < node.scalar; });
    if (above == nodes.begin()) return nodes.front().*value;
    if (above == nodes.end()) return nodes.back().*value;
    const Node& below = *(above - 1);
    if (scalar == above->scalar) return (*above).*value;
    const double width = above->scalar - below.scalar;
    return below.*value * ((above->scalar - scalar) / width) + (*above).*value * ((scalar - below.scalar) / width);
}

/// How many of the first of ascending `breaks` are `before` scalar. Few are compared one and all: a binary search over
/// random scalars costs more in mispredicted branches.
template <class Before>
std::size_t countOf(const std::vector<double>& breaks, double scalar, const Before& before) {
    constexpr std::size_t few = 24;
    if (breaks.size() > few) {
        return static_cast<std::size_t>(
            std::partition_point(breaks.begin(), breaks.end(), [&](double node) { return before(node, scalar); }) -
            breaks.begin());
    }
    std::size_t count = 0;
    for (const double node : breaks) count += before(node, scalar) ? 1u : 0u;
    return count;
}

template <class Node>
bool ascending(const std::vector<Node>& nodes) {
    return std::is_sorted(nodes.begin(), nodes.end(), [](const Node& a, const Node& b) { return a.scalar < b.scalar; });
}

}  // namespace

double SegmentResult::opacity() const {
    return -std::expm1(-opticalDepth);
}
double SegmentResult::transmittance() const {
    return std::exp(-opticalDepth);
}

ExactIntegral::ExactIntegral(const TransferFunction& function) : function_(function) {
    if (function_.normalized || function_.extinctionPerExtent) {
        throw std::runtime_error("transfer function is relative to a field; make it absolute with resolved() first");
    }
    if (function_.color.empty()) throw std::runtime_error("transfer function has no color node; give at least one");
    if (!ascending(function_.color) || !ascending(function_.extinction)) {
        throw std::runtime_error("transfer function nodes are not in ascending order; sort them by scalar");
    }
    const auto usable = [](const ExtinctionNode& node) { return std::isfinite(node.scalar) && node.extinction >= 0.0; };
    if (!std::all_of(function_.extinction.begin(), function_.extinction.end(), usable) ||
        !std::all_of(function_.color.begin(), function_.color.end(),
                     [](const ColorNode& node) { return std::isfinite(node.scalar); })) {
        throw std::runtime_error(
            "transfer function has a node that is not finite or of negative extinction; mend that node");
    }
    if (function_.extinction.empty()) function_.extinction.push_back({function_.color.front().scalar, 0.0});
    std::stable_sort(function_.isosurfaces.begin(), function_.isosurfaces.end(),
                     [](const Isosurface& a, const Isosurface& b) { return a.value < b.value; });
    buildPieces();
}

void ExactIntegral::buildPieces() {
    for (const ColorNode& node : function_.color) breaks_.push_back(node.scalar);
    for (const ExtinctionNode& node : function_.extinction) breaks_.push_back(node.scalar);
    std::sort(breaks_.begin(), breaks_.end());
    breaks_.erase(std::unique(breaks_.begin(), breaks_.end()), breaks_.end());

    const auto& color = function_.color;
    const auto& extinction = function_.extinction;
    pieces_.push_back({-infinity, breaks_.front(), 0.0, extinction.front().extinction, extinction.front().extinction,
                       color.front().color, color.front().color, 0.0});
    double extinctionIntegral = 0.0;
    for (std::size_t i = 1; i < breaks_.size(); ++i) {
        const double low = breaks_[i - 1], high = breaks_[i];
        Piece piece{low,
                    high,
                    1.0 / (high - low),
                    valueFromInside(extinction, &ExtinctionNode::extinction, low, low),
                    valueFromInside(extinction, &ExtinctionNode::extinction, low, high),
                    valueFromInside(color, &ColorNode::color, low, low),
                    valueFromInside(color, &ColorNode::color, low, high),
                    extinctionIntegral};
        extinctionIntegral += 0.5 * (piece.extinctionLow + piece.extinctionHigh) * (high - low);
        pieces_.push_back(piece);
    }
    pieces_.push_back({breaks_.back(), infinity, 0.0, extinction.back().extinction, extinction.back().extinction,
                       color.back().color, color.back().color, extinctionIntegral});
}

std::size_t ExactIntegral::pieceFromAbove(double scalar) const {
    return countOf(breaks_, scalar, [](double node, double s) { return node <= s; });
}

std::size_t ExactIntegral::pieceFromBelow(double scalar) const {
    return countOf(breaks_, scalar, [](double node, double s) { return node < s; });
}

ExactIntegral::PointValue ExactIntegral::valueAt(const Piece& piece, double scalar) {
    if (piece.inverseWidth == 0.0) return {piece.colorLow, piece.extinctionLow};
    // Both weights by subtraction from their own end: relative accuracy where a value falls to 0.
    const double high = (scalar - piece.low) * piece.inverseWidth, low = (piece.high - scalar) * piece.inverseWidth;
    return {low * piece.colorLow + high * piece.colorHigh, low * piece.extinctionLow + high * piece.extinctionHigh};
}

void ExactIntegral::addPiece(const PointValue& front, const PointValue& back, double path, SegmentResult& sum) const {
    const double frontDepth = front.extinction * path, backDepth = back.extinction * path;
    const double depth = 0.5 * (frontDepth + backDepth);
    if (!(depth > 0.0)) return;
    SegmentResult part;
    part.opticalDepth = depth;
    if (front.color == back.color) {
        part.color = front.color * part.opacity();
    } else {
        const LinearPieceWeights weights = linearPieceWeights(frontDepth, backDepth);
        part.color = weights.frontWeight * front.color + weights.backWeight * back.color;
    }
    if (sum.opticalDepth == 0.0) {
        sum = part;
    } else {
        composite(sum, part);
    }
}

SegmentResult ExactIntegral::smoothSegment(double front, double back, double length, Integral integral) const {
    const bool rising = front <= back;
    const double low = rising ? front : back, high = rising ? back : front;
    const std::size_t first = pieceFromAbove(low), last = std::max(first, pieceFromBelow(high));
    const double path = integral == Integral::Standard ? length : high - low;
    SegmentResult sum;
    if (first == last) {
        addPiece(valueAt(pieces_[first], front), valueAt(pieces_[first], back), path, sum);
        return sum;
    }
    const double pathPerScalar = integral == Integral::Standard ? length / (high - low) : 1.0;
    for (std::size_t step = 0; step <= last - first; ++step) {
        const Piece& piece = pieces_[rising ? first + step : last - step];
        const double from = std::max(low, piece.low), to = std::min(high, piece.high);
        PointValue atFrom = from == piece.low ? PointValue{piece.colorLow, piece.extinctionLow} : valueAt(piece, from);
        PointValue atTo = to == piece.high ? PointValue{piece.colorHigh, piece.extinctionHigh} : valueAt(piece, to);
        if (!rising) std::swap(atFrom, atTo);
        addPiece(atFrom, atTo, (to - from) * pathPerScalar, sum);
    }
    return sum;
}

SegmentResult ExactIntegral::segment(double front, double back, double length, Integral integral) const {
    const std::vector<Isosurface>& surfaces = function_.isosurfaces;
    if (surfaces.empty() || front == back) return smoothSegment(front, back, length, integral);
    // Crossed are those with low < value ≤ high, whatever the direction.
    const bool rising = front < back;
    auto firstAbove = [&](double scalar) {
        return std::upper_bound(surfaces.begin(), surfaces.end(), scalar,
                                [](double s, const Isosurface& surface) { return s < surface.value; });
    };
    const auto begin = firstAbove(rising ? front : back), end = firstAbove(rising ? back : front);
    if (begin == end) return smoothSegment(front, back, length, integral);

    const double lengthPerScalar = length / std::abs(back - front);
    SegmentResult sum;
    double from = front;
    auto advance = [&](double to) {
        composite(sum, smoothSegment(from, to, lengthPerScalar * std::abs(to - from), integral));
        from = to;
    };
    for (auto left = end - begin, index = decltype(left){0}; index < left; ++index) {
        const Isosurface& surface = rising ? begin[index] : end[-1 - index];
        if (surface.value != from) advance(surface.value);
        compositeIsosurface(sum, surface);
    }
    if (from != back) advance(back);
    return sum;
}

ExactIntegral::PointValue ExactIntegral::valueFromAbove(double scalar) const {
    return valueAt(pieces_[pieceFromAbove(scalar)], scalar);
}

ExactIntegral::PointValue ExactIntegral::valueFromBelow(double scalar) const {
    return valueAt(pieces_[pieceFromBelow(scalar)], scalar);
}

double ExactIntegral::largestExtinction(double low, double high) const {
    double largest = std::max(valueFromAbove(low).extinction, valueFromBelow(high).extinction);
    for (const Piece& piece : pieces_) {
        if (piece.low > low && piece.low < high) largest = std::max(largest, piece.extinctionLow);
        if (piece.high > low && piece.high < high) largest = std::max(largest, piece.extinctionHigh);
    }
    return largest;
}

glm::dvec3 ExactIntegral::nearestVisibleColor(double low, double high, double limitLow, double limitHigh) const {
    const auto visible = [](const Piece& piece) { return piece.extinctionLow > 0.0 || piece.extinctionHigh > 0.0; };
    double distanceBelow = infinity, distanceAbove = infinity;
    glm::dvec3 below{0.0}, above{0.0};
    for (std::size_t i = pieceFromBelow(low) + 1; i-- > 0 && pieces_[i].high > limitLow;) {
        if (!visible(pieces_[i])) continue;
        const double at = std::min(low, pieces_[i].high);
        distanceBelow = low - at;
        below = valueAt(pieces_[i], at).color;
        break;
    }
    for (std::size_t i = pieceFromAbove(high); i < pieces_.size() && pieces_[i].low < limitHigh; ++i) {
        if (!visible(pieces_[i])) continue;
        const double at = std::max(high, pieces_[i].low);
        distanceAbove = at - high;
        above = valueAt(pieces_[i], at).color;
        break;
    }
    if (distanceBelow < distanceAbove) return below;
    if (distanceAbove < distanceBelow) return above;
    return std::isinf(distanceBelow) ? function_.colorAt(0.5 * (low + high)) : 0.5 * (below + above);
}

double ExactIntegral::extinctionIntegral(double scalar) const {
    const std::size_t index = pieceFromAbove(scalar);
    const Piece& piece = pieces_[index];
    const double anchor = index == 0 ? piece.high : piece.low;
    const double anchorExtinction = index == 0 ? piece.extinctionHigh : piece.extinctionLow;
    return piece.extinctionIntegralLow +
           0.5 * (anchorExtinction + valueAt(piece, scalar).extinction) * (scalar - anchor);
}

}  // namespace tetralux::preint
