// SPDX-License-Identifier: Apache-2.0
#include <preint/table_layout.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>
#include <glm/common.hpp>

namespace tetralux::preint {
namespace {

/// Scalars at which two nodes with different values stand.
template <class Node, class Value>
void addJumps(const std::vector<Node>& nodes, Value Node::*value, std::vector<double>& jumps) {
    for (std::size_t i = 1; i < nodes.size(); ++i) {
        if (nodes[i].scalar == nodes[i - 1].scalar && nodes[i].*value != nodes[i - 1].*value)
            jumps.push_back(nodes[i].scalar);
    }
}

std::vector<double> jumpsWithin(const TransferFunction& function, double low, double high) {
    std::vector<double> jumps;
    addJumps(function.color, &ColorNode::color, jumps);
    addJumps(function.extinction, &ExtinctionNode::extinction, jumps);
    std::sort(jumps.begin(), jumps.end());
    jumps.erase(std::unique(jumps.begin(), jumps.end()), jumps.end());
    // at the largest scalar the value is that from above, in a zone of its own
    std::erase_if(jumps, [&](double scalar) { return !(scalar > low && scalar <= high); });
    return jumps;
}

/// Adds to `strengths` by how much the slope of `value` changes at each node, per unit of `scale`.
template <class Node, class Size>
void addKinks(const std::vector<Node>& nodes, const Size& differencePerScale, std::map<double, double>& strengths) {
    auto slope = [&](std::size_t i, auto&& use) {  // between nodes i − 1 and i; none outside and at jumps
        if (i == 0 || i == nodes.size() || nodes[i].scalar == nodes[i - 1].scalar) return use(nullptr, nullptr, 1.0);
        return use(&nodes[i - 1], &nodes[i], nodes[i].scalar - nodes[i - 1].scalar);
    };
    for (std::size_t i = 0; i < nodes.size(); ++i) strengths[nodes[i].scalar] += differencePerScale(slope, i);
}

/// How much a kink at each node can hurt: change of slope of extinction over its largest value, and of colour, per
/// range.
std::map<double, double> kinkStrengths(const ExactIntegral& exact, double low, double high) {
    std::map<double, double> strengths;
    const double largest = exact.largestExtinction(low, high), range = high - low;
    const auto extinctionSlope = [&](const ExtinctionNode* a, const ExtinctionNode* b, double width) {
        return a == nullptr ? 0.0 : (b->extinction - a->extinction) / width;
    };
    const auto colorSlope = [&](const ColorNode* a, const ColorNode* b, double width) {
        return a == nullptr ? glm::dvec3(0.0) : (b->color - a->color) / width;
    };
    if (largest > 0.0) {
        addKinks(
            exact.function().extinction,
            [&](const auto& slope, std::size_t i) {
                return std::abs(slope(i + 1, extinctionSlope) - slope(i, extinctionSlope)) * range / largest;
            },
            strengths);
    }
    addKinks(
        exact.function().color,
        [&](const auto& slope, std::size_t i) {
            const glm::dvec3 change = glm::abs(slope(i + 1, colorSlope) - slope(i, colorSlope)) * range;
            return std::max({change.x, change.y, change.z});
        },
        strengths);
    std::erase_if(strengths, [&](const auto& entry) { return !(entry.first > low && entry.first < high); });
    return strengths;
}

/// The `most` strongest kinks that are not jumps, ascending.
std::vector<double> strongestKinks(const ExactIntegral& exact, double low, double high,
                                   const std::vector<double>& jumps, std::size_t most) {
    constexpr double weakest = 0.05;                // errs by weakest/(4·size): 5e-5 for 256 texels
    std::vector<std::pair<double, double>> ranked;  // strength, scalar
    for (const auto& [scalar, strength] : kinkStrengths(exact, low, high)) {
        if (strength > weakest && !std::binary_search(jumps.begin(), jumps.end(), scalar))
            ranked.emplace_back(strength, scalar);
    }
    std::sort(ranked.rbegin(), ranked.rend());
    ranked.resize(std::min(ranked.size(), most));
    std::vector<double> kinks;
    for (const auto& [strength, scalar] : ranked) kinks.push_back(scalar);
    std::sort(kinks.begin(), kinks.end());
    return kinks;
}

/// Jumps and changes of slope of extinction over [low, high], as PreintegrationTable::ramps has them.
std::vector<glm::dvec3> extinctionRamps(const ExactIntegral& exact, double low, double high) {
    std::vector<double> scalars{low};
    for (const ExtinctionNode& node : exact.function().extinction) {
        if (node.scalar > scalars.back() && node.scalar <= high) scalars.push_back(node.scalar);
    }
    std::vector<glm::dvec3> ramps;
    double slope = 0.0;
    for (std::size_t i = 0; i < scalars.size(); ++i) {
        const double next = i + 1 < scalars.size() ? scalars[i + 1] : high;
        const double above = exact.valueFromAbove(scalars[i]).extinction;
        const double slopeAbove =
            next > scalars[i] ? (exact.valueFromBelow(next).extinction - above) / (next - scalars[i]) : 0.0;
        const double below = i == 0 ? 0.0 : exact.valueFromBelow(scalars[i]).extinction;
        ramps.emplace_back(scalars[i], above - below, 0.5 * (slopeAbove - slope));
        slope = slopeAbove;
    }
    return ramps;
}

/// Whether float sums of the ramps keep extinction to some 1e-4 of 1/range, a scene's unit, or to 1e-5 of itself; every
/// ramp costs each look-up.
bool rampsAreAccurate(const std::vector<glm::dvec3>& ramps, double low, double high) {
    constexpr std::size_t most = 16;
    constexpr double largestSum = 2000.0, mostLost = 100.0;
    if (ramps.size() > most) return false;
    const auto holdsAt = [&](double scalar, std::size_t count) {
        double value = 0.0, sum = 0.0;  // of the first ramps, and of what they add or take
        for (std::size_t k = 0; k < count; ++k) {
            const double rise = 2.0 * ramps[k].z * (scalar - ramps[k].x);
            value += ramps[k].y + rise;
            sum += std::abs(ramps[k].y) + std::abs(rise);
        }
        return sum * (high - low) <= largestSum || sum <= mostLost * value;
    };
    for (std::size_t i = 0; i < ramps.size(); ++i) {
        const double end = i + 1 < ramps.size() ? ramps[i + 1].x : high;
        if (!holdsAt(ramps[i].x, i + 1) || !holdsAt(end, i + 1)) return false;
    }
    return true;
}

/// Texel index of each of `scalars`, the ends of a zone's pieces: 0, …, size − 1.
std::vector<int> texelsOf(const std::vector<double>& scalars, int size) {
    const std::size_t pieces = scalars.size() - 1;
    std::vector<int> texel{0};
    for (std::size_t i = 1; i <= pieces; ++i) {
        const double byWidth = (scalars[i] - scalars.front()) / (scalars.back() - scalars.front());
        const double even = static_cast<double>(i) / static_cast<double>(pieces);
        texel.push_back(std::max(texel.back() + 1, static_cast<int>(std::lround(0.5 * (byWidth + even) * (size - 1)))));
    }
    texel.back() = size - 1;
    for (std::size_t i = pieces; i > 1; --i) texel[i - 1] = std::min(texel[i - 1], texel[i] - 1);
    return texel;
}

/// Those of `kinks` that lie apart from each other and from the zone's ends by more than a float holds: between closer
/// ones the warp would rise so steeply that its sum of ramps cancels.
std::vector<double> resolvedKinks(const std::vector<double>& kinks, const glm::dvec2& zone) {
    const double narrowest = 1e-6 * (zone.y - zone.x);
    std::vector<double> resolved;
    double last = zone.x;
    for (const double kink : kinks) {
        if (kink - last <= narrowest || zone.y - kink <= narrowest) continue;
        resolved.push_back(kink);
        last = kink;
    }
    return resolved;
}

}  // namespace

ZoneKinks layOutTable(const ExactIntegral& exact, double scalarMin, double scalarMax, KinkCuts cuts,
                      PreintegrationTable& table) {
    if (!std::isfinite(scalarMin) || !std::isfinite(scalarMax) || scalarMax < scalarMin) {
        throw std::runtime_error(
            fmt::format("scalar range [{}, {}] of a pre-integration table is not a range; give finite, ascending ends",
                        scalarMin, scalarMax));
    }
    constexpr std::size_t mostWarps = 12, mostCuts = 32;
    std::vector<double> cutsAt = jumpsWithin(exact.function(), scalarMin, scalarMax);
    std::vector<double> kinks =
        strongestKinks(exact, scalarMin, scalarMax, cutsAt, cuts == KinkCuts::All ? mostCuts : mostWarps);
    if (cuts == KinkCuts::All) {
        cutsAt.insert(cutsAt.end(), kinks.begin(), kinks.end());
        std::sort(cutsAt.begin(), cutsAt.end());
        kinks.clear();
    }
    std::vector<Discontinuity> discontinuities;
    for (const Isosurface& surface : exact.function().isosurfaces) {
        if (surface.value > scalarMin && surface.value <= scalarMax && surface.opacity > 0.0) {
            discontinuities.push_back({surface.value, surface.opacity, surface.color, 0, 0});
        }
    }
    for (const double cut : cutsAt) {
        const bool shared = std::any_of(discontinuities.begin(), discontinuities.end(),
                                        [&](const Discontinuity& one) { return one.value == cut; });
        if (!shared) discontinuities.push_back({cut, 0.0, glm::dvec3{0.0}, 0, 0});
    }
    std::stable_sort(discontinuities.begin(), discontinuities.end(),
                     [](const Discontinuity& a, const Discontinuity& b) { return a.value < b.value; });

    auto zoneOf = [&](auto count) { return static_cast<int>(count - cutsAt.begin()); };
    for (std::size_t i = 0; i < discontinuities.size(); ++i) {
        Discontinuity& one = discontinuities[i];
        one.zoneAbove = zoneOf(std::upper_bound(cutsAt.begin(), cutsAt.end(), one.value));
        one.zoneBelow =
            i > 0 ? discontinuities[i - 1].zoneAbove : 0;  // of several at one value the first changes the zone
    }
    table.discontinuities = std::move(discontinuities);

    table.zones.clear();
    double low = scalarMin;
    for (const double cut : cutsAt) {
        table.zones.emplace_back(low, cut);
        low = cut;
    }
    table.zones.emplace_back(low, scalarMax);

    ZoneKinks inZone(table.zones.size());
    for (const double kink : kinks) {
        inZone[static_cast<std::size_t>(std::upper_bound(cutsAt.begin(), cutsAt.end(), kink) - cutsAt.begin())]
            .push_back(kink);
    }
    table.ramps = extinctionRamps(exact, scalarMin, scalarMax);
    // also between cuts, at which a look-up keeps 1e-3 texel away from the zone's end (table_lookup.glsl): at the foot
    // of a ramp that is all of extinction, and silhouettes divide it by a small cosine
    if (cuts == KinkCuts::Ignored || !rampsAreAccurate(table.ramps, scalarMin, scalarMax)) table.ramps.clear();
    return inZone;
}

void placeTexels(const ZoneKinks& kinks, PreintegrationTable& table) {
    table.texelScalars.assign(table.zones.size() * table.size, 0.0);
    table.warp.clear();
    table.warped = false;
    double slope = 0.0;
    for (std::size_t z = 0; z < table.zones.size(); ++z) {
        const glm::dvec2& zone = table.zones[z];
        double* scalarOf = &table.texelScalars[z * table.size];
        std::vector<double> ends{zone.x};
        if (kinks[z].size() + 2 <= static_cast<std::size_t>(table.size) / 4) {
            for (const double kink : resolvedKinks(kinks[z], zone)) ends.push_back(kink);
        }
        ends.push_back(zone.y);
        table.warped = table.warped || ends.size() > 2;
        if (zone.x == zone.y) {  // a field of one value
            std::fill_n(scalarOf, table.size, zone.x);
            table.warp.emplace_back(zone.x, 0.0);
            continue;
        }
        const std::vector<int> texel = texelsOf(ends, table.size);
        for (std::size_t i = 1; i < ends.size(); ++i) {
            const int steps = texel[i] - texel[i - 1];
            for (int k = 0; k <= steps; ++k) {
                scalarOf[texel[i - 1] + k] = std::lerp(ends[i - 1], ends[i], static_cast<double>(k) / steps);
            }
            const double pieceSlope = steps / (table.size - 1.0) / (ends[i] - ends[i - 1]);
            table.warp.emplace_back(ends[i - 1], pieceSlope - slope);
            slope = pieceSlope;
        }
    }
}

}  // namespace tetralux::preint
