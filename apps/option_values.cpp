// SPDX-License-Identifier: Apache-2.0
#include <apps/option_values.h>

#include <charconv>
#include <cmath>
#include <stdexcept>
#include <vector>

#include <fmt/format.h>

namespace tetralux::apps {

namespace {

using projection::Mode;
using projection::OrderMethod;

constexpr int largestSide = 16384;  // pixels

template <class Value>
struct Named {
    Value value;
    const char* name;
};
constexpr Named<Mode> modes[] = {{Mode::Standard, "standard"},
                                 {Mode::ScaleInvariant, "scale-invariant"},
                                 {Mode::Mip, "mip"},
                                 {Mode::Minimum, "minimum"},
                                 {Mode::Average, "average"},
                                 {Mode::Additive, "additive"},
                                 {Mode::DataAdditive, "additive-scale-invariant"},
                                 {Mode::Emission, "emission"},
                                 {Mode::Absorption, "absorption"},
                                 {Mode::FirstHit, "first-hit"},
                                 {Mode::Depth, "depth"},
                                 {Mode::Contributions, "contributions"}};
constexpr Named<OrderMethod> orders[] = {
    {OrderMethod::Auto, "auto"}, {OrderMethod::Graph, "graph"}, {OrderMethod::Centroid, "centroid"}};

template <class Value, std::size_t n>
std::string namesOf(const Named<Value> (&all)[n]) {
    std::string names;
    for (const auto& named : all) names += fmt::format("{}{}", names.empty() ? "" : ", ", named.name);
    return names;
}

template <class Value, std::size_t n>
std::string nameOf(const Named<Value> (&all)[n], Value value) {
    for (const auto& named : all)
        if (value == named.value) return named.name;
    return "";
}

template <class Value, std::size_t n>
Value parseNamed(const Named<Value> (&all)[n], const char* what, const std::string& option, const std::string& text) {
    for (const auto& named : all)
        if (text == named.name) return named.value;
    throw std::runtime_error(fmt::format("{}: there is no {} '{}'; take one of {}", option, what, text, namesOf(all)));
}

/// The whole of `text` as a number; nothing when anything else stands there.
template <class Number>
std::optional<Number> parseNumber(std::string_view text) {
    Number value{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
    return value;
}

/// `count` finite numbers with commas between them.
std::optional<std::vector<double>> parseList(std::string_view text, std::size_t count) {
    std::vector<double> numbers;
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t comma = text.find(',');
        if ((comma == std::string_view::npos) != (i + 1 == count)) return std::nullopt;
        const auto number = parseNumber<double>(text.substr(0, comma));
        if (!number || !std::isfinite(*number)) return std::nullopt;
        numbers.push_back(*number);
        if (i + 1 < count) text.remove_prefix(comma + 1);
    }
    return numbers;
}

std::optional<glm::dvec3> parseTriple(std::string_view text) {
    const auto numbers = parseList(text, 3);
    if (!numbers) return std::nullopt;
    return glm::dvec3((*numbers)[0], (*numbers)[1], (*numbers)[2]);
}

}  // namespace

glm::dvec3 parseVector(const std::string& option, const std::string& text) {
    if (const auto triple = parseTriple(text)) return *triple;
    throw std::runtime_error(
        fmt::format("{}: '{}' is not three numbers; give x,y,z without spaces, such as 1,0.5,-2", option, text));
}

std::vector<double> parseNumbers(const std::string& option, const std::string& text, std::size_t count,
                                 const std::string& form) {
    if (auto numbers = parseList(text, count)) return std::move(*numbers);
    throw std::runtime_error(
        fmt::format("{}: '{}' is not {} numbers; give {} without spaces", option, text, count, form));
}

glm::dvec3 parseColor(const std::string& option, const std::string& text) {
    const auto color = parseTriple(text);
    if (color && color->x >= 0 && color->y >= 0 && color->z >= 0 && color->x <= 1 && color->y <= 1 && color->z <= 1)
        return *color;
    throw std::runtime_error(fmt::format("{}: '{}' is no colour; give r,g,b with each from 0 to 1, such as 1,0.5,0{}",
                                         option, text, option == "--background" ? ", or none" : ""));
}

glm::ivec2 parseSize(const std::string& option, const std::string& text) {
    const std::size_t cross = text.find('x');
    if (cross != std::string::npos) {
        const auto width = parseNumber<int>(std::string_view(text).substr(0, cross));
        const auto height = parseNumber<int>(std::string_view(text).substr(cross + 1));
        if (width && height && *width >= 1 && *height >= 1 && *width <= largestSide && *height <= largestSide)
            return {*width, *height};
    }
    throw std::runtime_error(
        fmt::format("{}: '{}' is no image size; give WxH with whole numbers from 1 to {}, such as 512x512", option,
                    text, largestSide));
}

std::optional<glm::vec3> parseBackground(const std::string& option, const std::string& text) {
    if (text == "none") return std::nullopt;
    return glm::vec3(parseColor(option, text));
}

Mode parseMode(const std::string& option, const std::string& text) {
    return parseNamed(modes, "mode", option, text);
}
std::string modeName(Mode mode) {
    return nameOf(modes, mode);
}
std::string modeNames() {
    return namesOf(modes);
}

bool parseIntegration(const std::string& option, const std::string& text) {
    if (text != "auto" && text != "exact")
        throw std::runtime_error(fmt::format("{}: '{}' is neither auto nor exact; give one of them", option, text));
    return text == "exact";
}

OrderMethod parseOrder(const std::string& option, const std::string& text) {
    return parseNamed(orders, "order", option, text);
}
std::string orderName(OrderMethod order) {
    return nameOf(orders, order);
}
std::string orderNames() {
    return namesOf(orders);
}

}  // namespace tetralux::apps
