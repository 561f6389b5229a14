// SPDX-License-Identifier: Apache-2.0
/// \file
/// Checked access to JSON values: every complaint names the origin, the place and the remedy on one line.
#pragma once

#include <string>

#include <glm/vec3.hpp>
#include <nlohmann/json.hpp>

#include <preint/transfer_function.h>

namespace tetralux::preint {

/// A JSON value and where it stands, such as `map.json: extinction[2][1]`.
class JsonPlace {
public:
    JsonPlace(const nlohmann::json& value, std::string origin) : value_(&value), origin_(std::move(origin)) {}

    const nlohmann::json& value() const { return *value_; }
    std::size_t size() const { return value_->size(); }

    JsonPlace member(const std::string& key) const;  ///< of an object that has it
    JsonPlace element(std::size_t index) const;      ///< of an array that is long enough

    double number() const;  ///< finite
    bool boolean() const;
    std::string text() const;
    glm::dvec3 color() const;                  ///< three numbers in [0, 1]
    double fraction(const char* what) const;   ///< a number in [0, 1]
    JsonPlace array(const char* shape) const;  ///< itself, when it is an array; `shape` shows the right one

    [[noreturn]] void fail(const std::string& complaint) const;

private:
    JsonPlace(const nlohmann::json& value, std::string origin, std::string path)
        : value_(&value), origin_(std::move(origin)), path_(std::move(path)) {}

    const nlohmann::json* value_;
    std::string origin_;
    std::string path_;
};

/// The object's keys must be among `known` (a comma-separated list for the message).
void requireKnownKeys(const JsonPlace& object, const std::vector<std::string>& known);

/// A colour map in ParaView's old XML or VisIt's, as ParaView exports it now.
nlohmann::json xmlColorMap(const std::string& text, const std::string& origin);

bool isParaViewColorMap(const nlohmann::json& document);

/// A colour map as ParaView exports it: `RGBPoints` in `ColorSpace`, opacity `Points`.
TransferFunction paraViewColorMap(const nlohmann::json& document, const std::string& origin);

}  // namespace tetralux::preint
