// SPDX-License-Identifier: Apache-2.0
#include <preint/opacity_words.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <functional>
#include <numeric>
#include <stdexcept>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <preint/similar_names.h>

namespace tetralux::preint {
namespace {

constexpr double tolerance = 1.0 / 1024.0;  // of α
constexpr int mostHalvings = 12;

/// Adds places of (low, high] until `straight(low, high)` holds of each piece.
void halve(double low, double high, const std::function<bool(double, double)>& straight, int left,
           std::vector<double>& places) {
    if (left == 0 || straight(low, high)) {
        places.push_back(high);
        return;
    }
    const double middle = std::midpoint(low, high);
    halve(low, middle, straight, left - 1, places);
    halve(middle, high, straight, left - 1, places);
}

std::vector<OpacityNode> sampled(const std::function<double(double)>& alpha) {
    constexpr int first = 8;
    const auto straight = [&](double low, double high) {
        bool good = true;
        for (int quarter = 1; quarter < 4; ++quarter) {
            const double share = 0.25 * quarter;
            const double gap = alpha(std::lerp(low, high, share)) - std::lerp(alpha(low), alpha(high), share);
            good = good && std::abs(gap) <= 0.5 * tolerance;
        }
        return good;
    };
    std::vector<double> places{0.0};
    for (int i = 0; i < first; ++i)
        halve(static_cast<double>(i) / first, static_cast<double>(i + 1) / first, straight, mostHalvings, places);
    std::vector<OpacityNode> nodes;
    for (const double place : places) nodes.push_back({place, alpha(place)});
    return nodes;
}

/// N of "sigmoid" and "sigmoid_N".
std::optional<double> steepness(std::string_view word) {
    constexpr std::string_view sigmoid = "sigmoid";
    if (!word.starts_with(sigmoid)) return std::nullopt;
    word.remove_prefix(sigmoid.size());
    if (word.empty()) return 10.0;
    if (word.front() != '_') return std::nullopt;
    int n = 0;
    const auto [end, error] = std::from_chars(word.data() + 1, word.data() + word.size(), n);
    if (error != std::errc() || end != word.data() + word.size() || n < 1 || n > 20) return std::nullopt;
    return n;
}

std::optional<std::vector<OpacityNode>> forwardWord(const std::string& word) {
    constexpr double least = 1e-6 / 255.0;  // where PyVista's geometric series begins
    if (word == "linear") return std::vector<OpacityNode>{{0.0, 0.0}, {1.0, 1.0}};
    if (word == "opaque") return std::vector<OpacityNode>{{0.0, 1.0}};
    if (word == "transparent") return std::vector<OpacityNode>{{0.0, 0.0}};
    if (word == "foreground") return std::vector<OpacityNode>{{1.0 / 256.0, 0.0}, {1.0 / 256.0, 1.0}};
    if (word == "geom") return sampled([](double f) { return std::pow(least, 1.0 - f); });
    if (const auto n = steepness(word))
        return sampled([n](double f) { return 1.0 / (1.0 + std::exp(-*n * (2.0 * f - 1.0))); });
    return std::nullopt;
}

}  // namespace

std::vector<std::string> opacityWords() {
    return {"linear",    "geom",       "sigmoid",    "sigmoid_3",  "sigmoid_5",
            "sigmoid_7", "sigmoid_15", "sigmoid_20", "foreground", "opaque"};
}

std::vector<OpacityNode> opacityOfWord(std::string_view word) {
    std::string lower(word);
    std::transform(lower.begin(), lower.end(), lower.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
    if (auto nodes = forwardWord(lower)) return std::move(*nodes);
    if (lower.ends_with("_r")) {
        if (auto nodes = forwardWord(lower.substr(0, lower.size() - 2))) {
            std::reverse(nodes->begin(), nodes->end());
            for (OpacityNode& node : *nodes) node.scalar = 1.0 - node.scalar;
            return std::move(*nodes);
        }
    }
    throw std::runtime_error(
        fmt::format("there is no opacity \"{}\";{} take one of {}, sigmoid_1 to sigmoid_20, any of them "
                    "reversed with _r",
                    word, didYouMean(word, opacityWords()), fmt::join(opacityWords(), ", ")));
}

std::vector<OpacityNode> opacityOfValues(const std::vector<double>& values) {
    if (values.empty()) throw std::runtime_error("opacity: a list of no values; give one from 0 to 1 at least");
    std::vector<OpacityNode> nodes;
    const double last = static_cast<double>(std::max<std::size_t>(1, values.size() - 1));
    for (const double value : values) {
        if (!(value >= 0.0 && value <= 1.0))
            throw std::runtime_error(fmt::format("opacity: {} in the list is not from 0 to 1", value));
        nodes.push_back({static_cast<double>(nodes.size()) / last, value});
    }
    return nodes;
}

std::vector<ExtinctionNode> opticalDepths(const std::vector<OpacityNode>& nodes, double most) {
    const auto depth = [most](double alpha) { return alpha < 1.0 ? std::min(most, -std::log1p(-alpha)) : most; };
    std::vector<ExtinctionNode> result;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        if (i > 0 && nodes[i].scalar > nodes[i - 1].scalar) {
            const OpacityNode &low = nodes[i - 1], &high = nodes[i];
            const auto alphaAt = [&](double share) { return std::lerp(low.opacity, high.opacity, share); };
            const auto straight = [&](double from, double to) {  // as α, of what is linear as depth
                bool good = true;
                for (int quarter = 1; quarter < 4; ++quarter) {
                    const double share = 0.25 * quarter;
                    const double line = std::lerp(depth(alphaAt(from)), depth(alphaAt(to)), share);
                    good = good && std::abs(-std::expm1(-line) - alphaAt(std::lerp(from, to, share))) <= tolerance;
                }
                return good;
            };
            std::vector<double> places;
            halve(0.0, 1.0, straight, mostHalvings, places);
            for (std::size_t k = 0; k + 1 < places.size(); ++k)
                result.push_back({std::lerp(low.scalar, high.scalar, places[k]), depth(alphaAt(places[k]))});
        }
        result.push_back({nodes[i].scalar, depth(nodes[i].opacity)});
    }
    return result;
}

}  // namespace tetralux::preint
