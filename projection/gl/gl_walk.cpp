// SPDX-License-Identifier: Apache-2.0
#include <projection/gl/gl_walk.h>

#include <algorithm>

#include <preint/exact_integral.h>

namespace tetralux::projection {

namespace {

/// The ends of a zone and the nodes between them, all of which float tells apart.
std::vector<double> breaksOf(const preint::TransferFunction& function, const glm::dvec2& zone) {
    std::vector<double> all{zone.x, zone.y};
    const auto add = [&](double scalar) {
        if (scalar > zone.x && scalar < zone.y) all.push_back(scalar);
    };
    for (const auto& node : function.color) add(node.scalar);
    for (const auto& node : function.extinction) add(node.scalar);
    std::sort(all.begin(), all.end());
    std::vector<double> kept;
    for (double scalar : all)
        if (kept.empty() || static_cast<float>(scalar) > static_cast<float>(kept.back())) kept.push_back(scalar);
    if (kept.size() == 1) kept.push_back(kept.front() + 1.0);  // a zone of one scalar
    return kept;
}

}  // namespace

bool nodesCloserThanTexels(const preint::TransferFunction& function, const preint::PreintegrationTable& table) {
    for (std::size_t zone = 0; zone < table.zones.size(); ++zone) {
        const auto begin = table.texelScalars.begin() + static_cast<std::ptrdiff_t>(zone) * table.size,
                   end = begin + table.size;
        std::ptrdiff_t last = -1;  // texels below the last node, where that is none's own
        for (double scalar : breaksOf(function, table.zones[zone])) {
            const auto above = std::lower_bound(begin, end, scalar);
            const bool own = above != end && static_cast<float>(*above) == static_cast<float>(scalar);
            if (!own && above - begin == last) return true;
            last = own ? -1 : above - begin;
        }
    }
    return false;
}

WalkedPieces walkedPieces(const preint::TransferFunction& function, const preint::PreintegrationTable& table) {
    const preint::ExactIntegral exact(function);
    std::vector<glm::vec4> ranges, low, high;
    WalkedPieces pieces;
    for (const glm::dvec2& zone : table.zones) {
        pieces.zonePiece.push_back(static_cast<int>(ranges.size()));
        const std::vector<double> breaks = breaksOf(function, zone);
        for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
            const auto a = exact.valueFromAbove(breaks[i]);
            const auto b = zone.y > zone.x ? exact.valueFromBelow(breaks[i + 1]) : a;
            ranges.emplace_back(glm::dvec4(breaks[i], breaks[i + 1], a.extinction, b.extinction));
            low.emplace_back(glm::dvec4(a.color, 0.0));
            high.emplace_back(glm::dvec4(b.color, 0.0));
        }
    }
    pieces.zonePiece.push_back(static_cast<int>(ranges.size()));
    pieces.texels = std::move(ranges);
    pieces.texels.insert(pieces.texels.end(), low.begin(), low.end());
    pieces.texels.insert(pieces.texels.end(), high.begin(), high.end());
    return pieces;
}

}  // namespace tetralux::projection
