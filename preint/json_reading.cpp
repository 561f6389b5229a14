// SPDX-License-Identifier: Apache-2.0
#include <preint/json_reading.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace tetralux::preint {
namespace {

/// The value as it may stand in a message: short, on one line, valid UTF-8.
std::string shown(const nlohmann::json& value) {
    std::string text = value.dump(-1, ' ', true, nlohmann::json::error_handler_t::replace);
    constexpr std::size_t most = 40;
    if (text.size() > most) text = text.substr(0, most) + "…";
    return text;
}

}  // namespace

JsonPlace JsonPlace::member(const std::string& key) const {
    return {value_->at(key), origin_, path_.empty() ? key : path_ + "." + key};
}

JsonPlace JsonPlace::element(std::size_t index) const {
    return {value_->at(index), origin_, fmt::format("{}[{}]", path_, index)};
}

void JsonPlace::fail(const std::string& complaint) const {
    throw std::runtime_error(fmt::format("{}: {}{}{}", origin_, path_, path_.empty() ? "" : " ", complaint));
}

double JsonPlace::number() const {
    if (!value_->is_number()) fail(fmt::format("is {}, must be a number", shown(*value_)));
    const double number = value_->get<double>();
    if (!std::isfinite(number)) fail("is not a finite number; write one that is");
    return number;
}

bool JsonPlace::boolean() const {
    if (!value_->is_boolean()) fail(fmt::format("is {}, must be true or false", shown(*value_)));
    return value_->get<bool>();
}

std::string JsonPlace::text() const {
    if (!value_->is_string()) fail(fmt::format("is {}, must be a text in quotes", shown(*value_)));
    return value_->get<std::string>();
}

double JsonPlace::fraction(const char* what) const {
    const double value = number();
    if (!(value >= 0.0 && value <= 1.0)) fail(fmt::format("is {}, but {} must lie between 0 and 1", value, what));
    return value;
}

glm::dvec3 JsonPlace::color() const {
    array("[r, g, b]");
    if (size() != 3) fail(fmt::format("has {} numbers, a color has three: [r, g, b]", size()));
    const char* what = "a color channel (divide channels of 0 to 255 by 255)";
    return {element(0).fraction(what), element(1).fraction(what), element(2).fraction(what)};
}

JsonPlace JsonPlace::array(const char* shape) const {
    if (!value_->is_array()) fail(fmt::format("is {}, must be a list: {}", shown(*value_), shape));
    return *this;
}

void requireKnownKeys(const JsonPlace& object, const std::vector<std::string>& known) {
    for (const auto& [key, value] : object.value().items()) {
        if (std::find(known.begin(), known.end(), key) == known.end()) {
            object.fail(fmt::format("has an unknown key {}; known are {}", shown(key), fmt::join(known, ", ")));
        }
    }
}

}  // namespace tetralux::preint
